// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/ros2/ros_messages.h"

namespace navcal::ros2 {

/// "/navcal/imu": names of letters, digits and _, each behind a slash.
[[nodiscard]] bool is_topic(const std::string& text);

/// A participant in a domain of DDS, by Cyclone DDS. Messages pass as bytes in CDR, so the library needs of a type
/// its name alone. Throws std::runtime_error with the reason in words where something cannot be made.
class Participant {
 public:
  using Handle = std::int32_t;
  using Type = protocols::ros2::MessageType;
  /// Called on a thread of the library's. A message longer than 64 KiB comes empty.
  using OnMessage = std::function<void(std::string_view cdr)>;

  explicit Participant(std::uint32_t domain);
  /// No reader calls any more afterwards.
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Reliable, volatile; both keep the last ten messages.
  [[nodiscard]] Handle add_writer(const std::string& topic, const Type& type);
  /// Best effort, volatile.
  void add_reader(const std::string& topic, const Type& type, OnMessage on_message);
  /// Never waits for a reader. False: the message did not leave.
  [[nodiscard]] static bool write(Handle writer, std::string_view cdr);

 private:
  [[nodiscard]] Handle add_topic(const std::string& topic, const Type& type);

  Handle participant_ = 0;
  std::vector<std::unique_ptr<OnMessage>> receivers_;
};

}  // namespace navcal::ros2

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace navcal::daemon {

/// A set of the log's topics that RECORD can carry: those with JSON messages, but for /config, which is not sent.
class RecordTopics {
 public:
  [[nodiscard]] static RecordTopics all();

  /// False when RECORD has no such topic.
  [[nodiscard]] bool add(std::string_view name);
  /// `topic`: number of record/log/log_topics.h.
  [[nodiscard]] bool has(std::uint16_t topic) const { return (bits_ >> topic & 1U) != 0; }
  /// "/time", "/event", ..., in the order of their numbers.
  [[nodiscard]] std::vector<std::string> names() const;
  /// The names with commas between them, for people.
  [[nodiscard]] std::string text() const;
  bool operator==(const RecordTopics&) const = default;

 private:
  std::uint32_t bits_ = 0;
};

/// Shortest times between two records of a topic and device that a client chose for single topics.
class RecordIntervals {
 public:
  /// False when RECORD has no such topic. 0: no limit.
  [[nodiscard]] bool set(std::string_view name, std::int64_t interval_ns);
  /// Absent where nothing was chosen for this topic: the interval of the class applies.
  [[nodiscard]] std::optional<std::int64_t> of(std::uint16_t topic) const;
  /// Names and intervals of the chosen topics, in the order of their numbers.
  [[nodiscard]] std::vector<std::pair<std::string, std::int64_t>> chosen() const;
  bool operator==(const RecordIntervals&) const = default;

 private:
  std::array<std::optional<std::int64_t>, 32> intervals_ns_{};  ///< by the topic's number
};

/// What a RECORD is about.
struct RecordKey {
  std::uint16_t topic = 0;            ///< number of record/log/log_topics.h
  std::optional<std::uint16_t> port;  ///< number of the device; absent: of no device
  bool at_a_rate = false;             ///< repeats by itself, so that a client may ask for fewer

  /// Distinguishes the topics and devices that take turns of their own.
  [[nodiscard]] std::uint16_t slot() const {
    constexpr unsigned kPortBits = 10;
    constexpr std::uint16_t kNoPort = (1U << kPortBits) - 1;
    return static_cast<std::uint16_t>(topic << kPortBits | port.value_or(kNoPort));
  }
};

}  // namespace navcal::daemon

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "analysis/import/import_sink.h"
#include "analysis/import/ros_messages.h"
#include "ros2/dds.h"

namespace navcal::ros2 {

/// A topic whose messages are samples for navcald.
struct Source {
  const analysis::ros::MessageType* type = nullptr;
  analysis::ros::Topic topic;
  std::uint64_t taken = 0, refused = 0;  ///< refused: no whole message of the type
};
/// "imu=/imu/data"; nullopt when it names none of kKinds, or no topic.
[[nodiscard]] std::optional<Source> read_source(std::string_view text);
inline constexpr const char* kKinds = "imu, mag, pressure, fix, twist";

/// Hands messages of other nodes to a port `samples` of navcald as lines, with the stamp of their header as time
/// of validity. It connects again by itself; while there is no connection, samples are lost and counted.
class Intake final : public analysis::ImportSink {
 public:
  Intake(const boost::asio::any_io_executor& executor, std::string port, std::list<Source> sources);
  /// Must not be destroyed before `participant`.
  void start(Participant& participant);
  /// Messages of each topic, and samples that were lost on the way to navcald.
  [[nodiscard]] std::string summary();

  void sample(const analysis::ImportedSample& sample, protocols::samples_line::LineWriter& line) override;
  void left(std::string_view) override {}
  void utc(std::int64_t, std::int64_t) override {}
  void progress(std::uint64_t) override {}

 private:
  void take(Source& source, std::string_view cdr);
  boost::asio::awaitable<void> run();
  /// Takes the lines that wait.
  [[nodiscard]] std::string next(bool connected);

  std::string port_;
  boost::asio::local::stream_protocol::socket socket_;
  boost::asio::steady_timer wake_;  ///< cancelled when there is something to send
  std::mutex mutex_;                ///< of all below: messages come on threads of DDS
  std::list<Source> sources_;
  std::string waiting_;  ///< whole lines
  bool connected_ = false;
  std::atomic<std::uint64_t> lost_ = 0;
};

}  // namespace navcal::ros2

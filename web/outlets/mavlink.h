// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ports/port.h"
#include "protocols/mavlink.h"
#include "protocols/mavlink_signer.h"
#include "web/hub.h"
#include "web/outlets/mavlink_messages.h"

namespace navcal::web {

struct MavlinkCounters {
  bool open = false;
  bool has_position = false;  ///< ODOMETRY or GPS_INPUT goes out
  std::uint64_t sent = 0;     ///< messages that the driver took
  std::uint64_t dropped = 0;  ///< because the line was slower, or away, or had nobody at its other end
  std::uint64_t received = 0;
  std::uint64_t refused = 0;  ///< of those received: without a good signature
};

/// Sends to an autopilot or a ground station by MAVLink 2, as a component of the vehicle (docs/wires.md).
class Mavlink final : public Subscriber, public ports::PortListener {
 public:
  /// Throws std::runtime_error, which says what to do.
  Mavlink(const boost::asio::any_io_executor& executor, const MavlinkOptions& options, Hub& hub);
  ~Mavlink() override;
  Mavlink(const Mavlink&) = delete;
  Mavlink& operator=(const Mavlink&) = delete;

  [[nodiscard]] const MavlinkCounters& counters() const { return counters_; }
  void on_record(const Record& record) override { messages_.take(record, Pacer::Clock::now()); }

  void on_opened(std::int64_t now_ns, const ports::OpenPort& port) override;
  void on_bytes(std::int64_t arrival_ns, protocols::Bytes bytes) override;
  void on_sent(std::int64_t now_ns, protocols::Bytes bytes) override;
  void on_dropped(protocols::Bytes bytes) override;
  void on_lost(std::int64_t now_ns, std::string_view reason) override;

 private:
  void tick();
  void wait();
  void send(std::uint32_t id, protocols::Bytes payload);
  void send(std::vector<std::uint8_t> frame);
  [[nodiscard]] protocols::mavlink::Sender sender() { return {options_.system, options_.component, sequence_++}; }

  MavlinkOptions options_;
  Hub& hub_;
  boost::asio::steady_timer timer_;
  MavlinkMessages messages_;
  std::optional<protocols::mavlink::Signer> signer_;
  protocols::mavlink::Parser sent_, dropped_, received_;
  MavlinkCounters counters_;
  std::uint8_t sequence_ = 0;
  std::string told_;
  ports::Port port_;
};

/// Empty for an address of a port, or the path of a serial one.
[[nodiscard]] std::string problem_of_mavlink_address(const std::string& text);

}  // namespace navcal::web

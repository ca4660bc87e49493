// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "web/hub.h"
#include "web/outlets/outlet_options.h"

namespace navcal::web {

struct MavlinkCounters {
  bool open = false;
  bool has_position = false;  ///< ODOMETRY or GPS_INPUT goes out
  std::uint64_t sent = 0;     ///< messages that the driver took
  std::uint64_t dropped = 0;  ///< because the line was slower, or away, or had nobody at its other end
  std::uint64_t received = 0;
  std::uint64_t refused = 0;  ///< of those received: without a good signature
};

/// Sends to an autopilot or a ground station by MAVLink 2, as a component of the vehicle (docs/wires.md), as long
/// as it lives. Throws std::runtime_error, which says what to do.
[[nodiscard]] std::unique_ptr<Subscriber> make_mavlink(const boost::asio::any_io_executor& executor,
                                                       const MavlinkOptions& options, Hub& hub,
                                                       MavlinkCounters& counters);

/// Empty for an address of a port, or the path of a serial one.
[[nodiscard]] std::string problem_of_mavlink_address(const std::string& text);

}  // namespace navcal::web

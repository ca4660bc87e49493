// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "config/settings.h"
#include "protocols/frame.h"

namespace navcal::daemon {

/// The line under the remote link: a serial port or a TCP connection. It comes and goes by itself.
class RemoteLine {
 public:
  struct Events {
    std::function<void(std::int64_t now_ns, protocols::Bytes bytes)> on_bytes;
    /// The line is there, or away; for people.
    std::function<void(std::int64_t now_ns, bool is_open, std::string_view words)> on_state;
  };

  virtual ~RemoteLine() = default;
  virtual void start() = 0;
  virtual void stop() = 0;
  /// A whole frame. It is dropped while the line is away or takes nothing: nobody waits for a line.
  virtual void send(protocols::Bytes frame) = 0;
};

/// Throws StartError when an address cannot be listened on.
[[nodiscard]] std::unique_ptr<RemoteLine> make_remote_line(const boost::asio::any_io_executor& executor,
                                                           const config::RemoteSettings& settings,
                                                           RemoteLine::Events events);

}  // namespace navcal::daemon

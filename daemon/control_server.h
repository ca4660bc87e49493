// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "daemon/control_request.h"

namespace navcal::daemon {

/// Socket for requests that change the daemon: one JSON object per line in, one out. It is a Unix socket whose
/// permissions decide who may connect (docs/status-protocol.md).
class ControlServer {
 public:
  /// Answers a request with one line.
  using Handler = std::function<std::string(const ControlRequest&, const ControlOrigin&)>;
  /// A connection is closed; its number is never used again.
  using Gone = std::function<void(std::uint64_t client)>;

  /// `own_path` is removed at the end; empty when the socket belongs to systemd.
  ControlServer(boost::asio::local::stream_protocol::acceptor acceptor, std::filesystem::path own_path,
                Handler handler, Gone gone);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  void start();
  void stop();

 private:
  using Socket = boost::asio::local::stream_protocol::socket;
  boost::asio::awaitable<void> accept_clients();
  boost::asio::awaitable<void> serve(std::shared_ptr<Socket> socket, std::uint64_t client);
  [[nodiscard]] std::string answer(std::string_view line, const ControlOrigin& origin) const;

  boost::asio::local::stream_protocol::acceptor acceptor_;
  std::filesystem::path own_path_;
  Handler handler_;
  Gone gone_;
  std::uint64_t last_client_ = 0;
  std::set<std::shared_ptr<Socket>> clients_;
};

}  // namespace navcal::daemon

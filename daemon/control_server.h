// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/thread_pool.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "daemon/control_request.h"

namespace navcal::daemon {

/// Socket for requests that change the daemon: one JSON object per line in, one out. It is a Unix socket whose
/// permissions decide who may connect (docs/status-protocol.md).
class ControlServer {
 public:
  /// Answers a request with one line, or with work that makes it.
  using Handler = std::function<ControlAnswer(const ControlRequest&, const ControlOrigin&)>;
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
  [[nodiscard]] ControlAnswer answer(std::string_view line, const ControlOrigin& origin) const;
  /// The line of an answer, whose work is done on a thread of its own: the disk may be slow.
  boost::asio::awaitable<std::string> line_of(ControlAnswer answer);

  boost::asio::local::stream_protocol::acceptor acceptor_;
  std::filesystem::path own_path_;
  Handler handler_;
  Gone gone_;
  std::uint64_t last_client_ = 0;
  std::set<std::shared_ptr<Socket>> clients_;
  std::optional<boost::asio::thread_pool> reader_;  ///< one thread, begun with the first answer that needs it
};

}  // namespace navcal::daemon

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/thread_pool.hpp>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "daemon/control_request.h"
#include "daemon/lazy_timer.h"

namespace navcal::daemon {

/// Told by the server what its clients do.
class ControlOwner {
 public:
  virtual ~ControlOwner() = default;
  [[nodiscard]] virtual ControlAnswer on_control(const ControlRequest& request, const ControlOrigin& origin) = 0;
  /// A connection is closed and its number is never used again, or it has lost what it had for another reason.
  virtual void control_client_gone(std::uint64_t client, std::string_view reason) = 0;
  /// Whether the lease of the motor is this client's.
  [[nodiscard]] virtual bool is_in_charge(std::uint64_t client) const = 0;
};

/// Socket for requests that change the daemon: one JSON object per line in, one out. It is a Unix socket whose
/// permissions decide who may connect (docs/status-protocol.md).
class ControlServer {
 public:
  /// `own_path` is removed at the end; empty when the socket belongs to systemd.
  ControlServer(boost::asio::local::stream_protocol::acceptor acceptor, std::filesystem::path own_path,
                ControlOwner& owner);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  void start();
  void stop();

 private:
  struct Client {
    boost::asio::local::stream_protocol::socket socket;
    std::uint64_t number = 0;
    std::int64_t used_ns = 0;             ///< when it came or asked last
    std::int64_t empty_ns = 0;            ///< when nothing waited to be read: what is read next was sent later
    std::deque<ControlAnswer> answers{};  ///< in the order of the requests
    bool is_answering = false;
  };
  boost::asio::awaitable<void> accept_clients();
  /// Carries requests out as they come, also while an answer before them waits for the disk.
  boost::asio::awaitable<void> serve(std::shared_ptr<Client> client);
  boost::asio::awaitable<void> write_answers(std::shared_ptr<Client> client);
  /// Closes the client that has been idle for longest, of those not in charge.
  void make_place();
  void look_at_buffers();
  static void drop_after(const std::exception_ptr& failure, Client& client);
  [[nodiscard]] ControlAnswer answer(std::string_view line, const ControlOrigin& origin) const;
  /// The line of an answer, whose work is done on a thread of its own: the disk may be slow.
  boost::asio::awaitable<std::string> line_of(ControlAnswer answer);

  boost::asio::local::stream_protocol::acceptor acceptor_;
  std::filesystem::path own_path_;
  ControlOwner& owner_;
  std::uint64_t last_client_ = 0;
  std::set<std::shared_ptr<Client>> clients_;
  LazyTimer look_timer_;
  std::optional<boost::asio::thread_pool> reader_;  ///< one thread, begun with the first answer that needs it
  std::optional<boost::asio::thread_pool> keeper_;  ///< others for leases and stops, which wait for no download
};

}  // namespace navcal::daemon

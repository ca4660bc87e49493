// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "daemon/client_queue.h"
#include "daemon/request.h"

namespace navcal::daemon {

class StatusClient;

/// Who answers the requests of clients.
class ClientOwner {
 public:
  virtual ~ClientOwner() = default;
  virtual void on_request(StatusClient& client, const Request& request) = 0;
  /// A client that missed reports has read all that was waiting for it.
  virtual void on_caught_up(StatusClient& client) = 0;
  virtual void on_gone(const StatusClient& client) = 0;
};

/// One client of the status socket. What it cannot take at once waits in its own bounded queue; nobody else waits.
class StatusClient : public std::enable_shared_from_this<StatusClient> {
 public:
  /// What it asked to see.
  struct Policy {
    bool enable = false;
    bool json = false;
    std::optional<std::uint16_t> port;  ///< one device only
  };

  StatusClient(boost::asio::ip::tcp::socket socket, std::size_t queue_bytes, ClientOwner& owner);

  void start();
  /// Whole reports, newline included. Never waits: written at once, queued, or dropped and counted.
  void send(std::string_view report);
  void close();

  [[nodiscard]] bool watches() const { return policy_.enable && policy_.json; }
  [[nodiscard]] bool watches(std::uint16_t port) const { return watches() && policy_.port.value_or(port) == port; }
  [[nodiscard]] Policy& policy() { return policy_; }
  [[nodiscard]] std::uint64_t dropped() const { return queue_.dropped(); }
  [[nodiscard]] std::size_t queued_bytes() const { return queue_.size(); }

 private:
  boost::asio::awaitable<void> session();
  boost::asio::awaitable<void> read_requests();
  boost::asio::awaitable<void> refuse(std::string_view reason);
  void take_line(std::string_view line);
  void wait_until_writable();
  void flush();

  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer give_up_;
  ClientQueue queue_;
  ClientOwner& owner_;
  Policy policy_;
  std::uint64_t told_dropped_ = 0;
  bool waiting_ = false;
};

}  // namespace navcal::daemon

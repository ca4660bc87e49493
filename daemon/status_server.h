// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "daemon/status_client.h"

namespace navcal::daemon {

/// Interface through which the server gets answers from the daemon.
class StatusSource {
 public:
  virtual ~StatusSource() = default;
  [[nodiscard]] virtual std::uint16_t device_count() const = 0;
  [[nodiscard]] virtual std::optional<std::uint16_t> device_named(std::string_view name) const = 0;
  [[nodiscard]] virtual std::string_view device_name(std::uint16_t port) const = 0;
  /// The DEVICE object, without newline.
  virtual void append_device(std::string& out, std::uint16_t port) const = 0;
  /// The answer to ?POLL;, one line.
  virtual void append_poll(std::string& out) const = 0;
  /// A client has changed its reports or their rates.
  virtual void on_watch_changed() = 0;
};

/// gpsd's protocol on TCP (docs/status-protocol.md). Everything a client can do here is reading.
class StatusServer : private ClientOwner {
 public:
  StatusServer(boost::asio::ip::tcp::acceptor acceptor, const config::StatusSettings& settings,
               StatusSource& source);

  void start();
  void stop();

  /// True when any client watches a report of this port now; otherwise it need not be written.
  [[nodiscard]] bool watched(ReportClass report, std::uint16_t port) const;
  /// The same for a report that belongs to no port.
  [[nodiscard]] bool watched(ReportClass report) const;
  /// One whole line about one port, to everybody who watches it.
  void publish(ReportClass report, std::uint16_t port, std::string_view line);
  /// One whole line to everybody who watches the class; `slot` numbers lines that belong together.
  void publish(ReportClass report, std::string_view line, std::uint16_t slot = 0);
  /// The same for RECORD.
  [[nodiscard]] bool watched(const RecordKey& key) const;
  void publish(const RecordKey& key, std::string_view line);
  /// The same for NMEA sentences, which may be several lines.
  [[nodiscard]] bool watched(const NmeaKey& key) const;
  void publish(const NmeaKey& key, std::string_view sentences);
  /// STATE at a rate: when the next one is due to any client, monotonic; INT64_MAX: to none. The grid is the same
  /// for all clients of one rate.
  [[nodiscard]] std::int64_t next_state_ns() const;
  /// True when any client wants a STATE with each compass word.
  [[nodiscard]] bool wants_state_of_words() const;
  /// To those whose time has come, or, with `of_word`, to those who want one with each word.
  void publish_state(std::string_view line, std::int64_t now_ns, bool of_word);
  /// HEALTH lines without their end; each client's own count of dropped reports is added. Kept for clients that
  /// catch up.
  void publish_health(std::vector<std::string> beginnings);
  /// Tells watchers that a device came or went.
  void publish_device(std::uint16_t port);

  [[nodiscard]] std::size_t clients() const { return clients_.size(); }
  [[nodiscard]] std::uint64_t dropped() const;
  [[nodiscard]] std::size_t queued_bytes() const;
  [[nodiscard]] std::uint16_t port() const;

 private:
  void on_request(StatusClient& client, const Request& request) override;
  void on_caught_up(StatusClient& client) override;
  void on_gone(const StatusClient& client) override;
  boost::asio::awaitable<void> accept_clients();
  void welcome(boost::asio::ip::tcp::socket socket);
  /// Closes the client that has been idle for longest; false when all watch.
  [[nodiscard]] bool make_place();
  void change_watch(StatusClient& client, const WatchChange& change);
  void append_devices();
  void append_policy(StatusClient& client);
  void send_health(StatusClient& client);

  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  config::StatusSettings settings_;
  StatusSource& source_;
  std::vector<std::shared_ptr<StatusClient>> clients_;
  std::vector<std::string> health_;
  std::string answer_;
  std::uint64_t dropped_by_gone_ = 0;
};

}  // namespace navcal::daemon

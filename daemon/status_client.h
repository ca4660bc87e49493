// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "control/order_rate.h"
#include "daemon/client_queue.h"
#include "daemon/record_topics.h"
#include "daemon/report_class.h"
#include "daemon/request.h"

namespace navcal::daemon {

class StatusClient;

/// More requests than this a client has answered later.
inline constexpr double kMaxRequests_Hz = 20;

/// What NMEA sentences are about.
struct NmeaKey {
  ReportClass like{};      ///< report that tells the same in JSON
  std::uint16_t port = 0;  ///< number of the device
  bool serves = true;      ///< false: only for clients that have selected this device
};

/// Owner of the clients, which answers their requests.
class ClientOwner {
 public:
  virtual ~ClientOwner() = default;
  virtual void on_request(StatusClient& client, const Request& request) = 0;
  /// A client that missed reports has read all that was waiting for it.
  virtual void on_caught_up(StatusClient& client) = 0;
  virtual void on_gone(const StatusClient& client) = 0;
};

/// One client of the status socket. Reports that it cannot take at once wait in its own bounded queue, so that
/// no other client waits.
class StatusClient : public std::enable_shared_from_this<StatusClient> {
 public:
  /// Reports that the client has selected.
  struct Policy {
    bool enable = false;
    bool json = false;
    bool nmea = false;
    std::int64_t nmea_interval_ns = kNmeaInterval_ns;
    std::optional<std::uint16_t> port;  ///< one device only
    ReportClasses classes = ReportClasses::usual();
    ReportIntervals intervals_ns{};
    RecordTopics topics = RecordTopics::all();
    RecordIntervals topic_intervals_ns;
    std::int64_t state_due_ns = 0;  ///< of the next STATE at a rate
  };

  StatusClient(boost::asio::ip::tcp::socket socket, std::size_t queue_bytes, ClientOwner& owner);

  void start();
  /// Whole reports, newline included. Never waits: written at once, queued, or dropped and counted.
  void send(std::string_view report);
  void close();

  /// A client that is connected and watches nothing may lose its place to another.
  [[nodiscard]] bool is_idle() const { return socket_.is_open() && !policy_.enable; }
  /// When it came or asked last, monotonic.
  [[nodiscard]] std::int64_t used_ns() const { return used_ns_; }
  [[nodiscard]] bool watches(ReportClass report) const {
    return policy_.enable && policy_.json && policy_.classes.has(report);
  }
  [[nodiscard]] bool watches(ReportClass report, std::uint16_t port) const {
    return watches(report) && policy_.port.value_or(port) == port;
  }
  [[nodiscard]] bool watches(const RecordKey& key) const {
    return watches(ReportClass::record, key.port.value_or(policy_.port.value_or(0))) &&
           policy_.topics.has(key.topic);
  }
  [[nodiscard]] bool watches(const NmeaKey& key) const {
    return policy_.enable && policy_.nmea && (policy_.port ? *policy_.port == key.port : key.serves);
  }
  /// True when the client's chosen rate allows another report of this class and slot (a device, a part) now.
  [[nodiscard]] bool is_due(ReportClass report, std::uint16_t slot) const;
  /// Same as is_due(), and counts the report.
  [[nodiscard]] bool take_turn(ReportClass report, std::uint16_t slot);
  [[nodiscard]] bool is_due(const RecordKey& key) const;
  [[nodiscard]] bool take_turn(const RecordKey& key);
  [[nodiscard]] bool is_due(const NmeaKey& key) const;
  [[nodiscard]] bool take_turn(const NmeaKey& key);
  /// Shortest time between two reports; 0: no limit.
  [[nodiscard]] std::int64_t interval_ns(ReportClass report) const {
    return policy_.intervals_ns.at(static_cast<std::size_t>(report));
  }
  [[nodiscard]] Policy& policy() { return policy_; }
  /// Restarts the pacing after a change of rates: earlier reports do not count.
  void begin_pacing() {
    pacer_.forget();
    nmea_pacer_.forget();
  }
  [[nodiscard]] std::uint64_t dropped() const { return queue_.dropped(); }
  [[nodiscard]] std::size_t queued_bytes() const { return queue_.size(); }

 private:
  [[nodiscard]] std::int64_t interval_ns(const RecordKey& key) const;
  boost::asio::awaitable<void> session();
  boost::asio::awaitable<void> read_requests();
  boost::asio::awaitable<void> refuse(std::string_view reason);
  /// Answers requests one by one: no more than kMaxRequests_Hz, and none while answers before it wait to be read.
  boost::asio::awaitable<void> answer(std::vector<Request> requests);
  void wait_until_writable();
  void flush();

  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer pause_;
  control::OrderRate requests_;
  ClientQueue queue_;
  ClientOwner& owner_;
  Policy policy_;
  ReportPacer pacer_;
  ReportPacer nmea_pacer_;
  std::int64_t used_ns_;
  std::uint64_t told_dropped_ = 0;
  bool waiting_ = false;
};

}  // namespace navcal::daemon

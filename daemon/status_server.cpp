// SPDX-License-Identifier: Apache-2.0
#include "daemon/status_server.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/use_awaitable.hpp>

#include "daemon/gpsd_replies.h"
#include "daemon/json_text.h"
#include "ports/no_throw.h"

namespace navcal::daemon {
namespace asio = boost::asio;
namespace {

/// Out of descriptors or memory: accepting again at once would only spin.
constexpr auto kAcceptPause = std::chrono::milliseconds(500);

}  // namespace

StatusServer::StatusServer(asio::ip::tcp::acceptor acceptor, const config::StatusSettings& settings,
                           StatusSource& source)
    : acceptor_(std::move(acceptor)), pause_(acceptor_.get_executor()), settings_(settings), source_(source) {}

void StatusServer::start() { asio::co_spawn(acceptor_.get_executor(), accept_clients(), asio::detached); }

void StatusServer::stop() {
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  pause_.cancel();
  for (const auto& client : clients_) client->close();
}

asio::awaitable<void> StatusServer::accept_clients() {
  while (acceptor_.is_open()) {
    auto [error, socket] = co_await acceptor_.async_accept(ports::kNoThrow);
    if (!acceptor_.is_open()) co_return;
    if (!error) {
      welcome(std::move(socket));
    } else if (error != asio::error::connection_aborted) {
      spdlog::warn("status socket: cannot accept: {}", error.message());
      pause_.expires_after(kAcceptPause);
      co_await pause_.async_wait(ports::kNoThrow);
    }
  }
}

void StatusServer::welcome(asio::ip::tcp::socket socket) {
  if (clients_.size() >= settings_.max_clients && !make_place()) {
    answer_.clear();
    append_error(answer_, fmt::format("Too many clients: {} are connected", clients_.size()));
    // The answer is sent without waiting. An empty send buffer takes it whole.
    if (::send(socket.native_handle(), answer_.data(), answer_.size(), MSG_DONTWAIT | MSG_NOSIGNAL) < 0) {
      spdlog::debug("status socket: a refused client was gone already");
    }
    return;
  }
  ClientOwner& owner = *this;
  clients_.push_back(std::make_shared<StatusClient>(std::move(socket), settings_.client_queue_bytes, owner));
  clients_.back()->start();
}

bool StatusServer::make_place() {
  const auto rank = [](const auto& client) { return std::pair(!client->is_idle(), client->used_ns()); };
  const auto longest =
      std::ranges::min_element(clients_, [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  if (longest == clients_.end() || rank(*longest).first) return false;
  (*longest)->close();
  return true;
}

void StatusServer::on_gone(const StatusClient& client) {
  dropped_by_gone_ += client.dropped();
  std::erase_if(clients_, [&](const auto& entry) { return entry.get() == &client; });
}

void StatusServer::on_request(StatusClient& client, const Request& request) {
  answer_.clear();
  switch (request.kind) {
    case Request::Kind::version: append_version(answer_); break;
    case Request::Kind::devices: append_devices(); break;
    case Request::Kind::poll: source_.append_poll(answer_); break;
    case Request::Kind::records: append_records(answer_); break;
    case Request::Kind::not_understood: append_error(answer_, request.message); break;
    case Request::Kind::device:
      for (std::uint16_t port = 0; port < source_.device_count(); ++port) {
        if (request.device && *request.device != source_.device_name(port)) continue;
        source_.append_device(answer_, port);
        answer_ += kLineEnd;
      }
      if (answer_.empty())
        append_error(answer_, fmt::format("No such device as {}", request.device.value_or("any")));
      break;
    case Request::Kind::watch:
      if (request.watch) {
        change_watch(client, *request.watch);
      } else {
        append_devices();
        append_policy(client);
      }
      break;
  }
  client.send(answer_);
}

void StatusServer::change_watch(StatusClient& client, const WatchChange& change) {
  auto& policy = client.policy();
  if (change.device && change.enable) {
    const auto port = source_.device_named(*change.device);
    if (!port) {
      append_error(answer_, fmt::format("No such device as {}", *change.device));
      return;
    }
    policy.port = port;
  }
  policy.enable = change.enable;
  policy.json = change.json.value_or(policy.json);
  policy.nmea = change.nmea.value_or(policy.nmea);
  policy.classes = change.classes.value_or(policy.classes);
  policy.topics = change.topics.value_or(policy.topics);
  policy.nmea_interval_ns = change.nmea_interval_ns.value_or(policy.nmea_interval_ns);
  if (change.nmea_interval_ns) client.begin_pacing();
  if (change.topic_intervals_ns) {
    policy.topic_intervals_ns = *change.topic_intervals_ns;
    client.begin_pacing();
  }
  if (change.intervals_ns) {
    policy.intervals_ns = *change.intervals_ns;
    policy.state_due_ns = 0;  // the first one comes at once
    client.begin_pacing();
  }
  source_.on_watch_changed();
  append_devices();
  append_policy(client);
}

void StatusServer::append_devices() {
  answer_ += R"({"class":"DEVICES","devices":[)";
  for (std::uint16_t port = 0; port < source_.device_count(); ++port) {
    if (port > 0) answer_ += ',';
    source_.append_device(answer_, port);
  }
  answer_ += "]}\r\n";
}

void StatusServer::append_policy(StatusClient& client) {
  const auto& policy = client.policy();
  std::optional<std::string_view> device;
  if (policy.port) device = source_.device_name(*policy.port);
  append_watch(answer_, {policy.enable, policy.json, policy.nmea, device, policy.classes, policy.intervals_ns,
                         policy.topics, policy.topic_intervals_ns, policy.nmea_interval_ns});
}

bool StatusServer::watched(ReportClass report, std::uint16_t port) const {
  return std::ranges::any_of(
      clients_, [&](const auto& client) { return client->watches(report, port) && client->is_due(report, port); });
}

bool StatusServer::watched(ReportClass report) const {
  return std::ranges::any_of(
      clients_, [&](const auto& client) { return client->watches(report) && client->is_due(report, 0); });
}

void StatusServer::publish(ReportClass report, std::uint16_t port, std::string_view line) {
  for (const auto& client : clients_) {
    if (client->watches(report, port) && client->take_turn(report, port)) client->send(line);
  }
}

void StatusServer::publish(ReportClass report, std::string_view line, std::uint16_t slot) {
  for (const auto& client : clients_) {
    if (client->watches(report) && client->take_turn(report, slot)) client->send(line);
  }
}

bool StatusServer::watched(const RecordKey& key) const {
  return std::ranges::any_of(clients_,
                             [&](const auto& client) { return client->watches(key) && client->is_due(key); });
}

void StatusServer::publish(const RecordKey& key, std::string_view line) {
  for (const auto& client : clients_) {
    if (!client->watches(key)) continue;
    if (client->take_turn(key)) client->send(line);
  }
}

bool StatusServer::watched(const NmeaKey& key) const {
  return std::ranges::any_of(clients_,
                             [&](const auto& client) { return client->watches(key) && client->is_due(key); });
}

void StatusServer::publish(const NmeaKey& key, std::string_view sentences) {
  for (const auto& client : clients_) {
    if (client->watches(key) && client->take_turn(key)) client->send(sentences);
  }
}

std::int64_t StatusServer::next_state_ns() const {
  std::int64_t next_ns = INT64_MAX;
  for (const auto& client : clients_) {
    if (client->watches(ReportClass::state) && client->interval_ns(ReportClass::state) > 0)
      next_ns = std::min(next_ns, client->policy().state_due_ns);
  }
  return next_ns;
}

bool StatusServer::wants_state_of_words() const {
  return std::ranges::any_of(clients_, [](const auto& client) {
    return client->watches(ReportClass::state) && client->interval_ns(ReportClass::state) == 0;
  });
}

void StatusServer::publish_state(std::string_view line, std::int64_t now_ns, bool of_word) {
  for (const auto& client : clients_) {
    if (!client->watches(ReportClass::state)) continue;
    const std::int64_t interval_ns = client->interval_ns(ReportClass::state);
    if (of_word != (interval_ns == 0)) continue;
    if (!of_word) {
      if (now_ns < client->policy().state_due_ns) continue;
      client->policy().state_due_ns = (now_ns / interval_ns + 1) * interval_ns;
    }
    client->send(line);
  }
}

void StatusServer::publish_health(std::vector<std::string> beginnings) {
  health_ = std::move(beginnings);
  for (const auto& client : clients_) {
    if (client->watches(ReportClass::health) && client->take_turn(ReportClass::health, 0)) send_health(*client);
  }
}

void StatusServer::send_health(StatusClient& client) {
  for (const std::string& beginning : health_) {
    answer_ = beginning;
    fmt::format_to(std::back_inserter(answer_), FMT_STRING(",\"dropped\":{}}}\r\n"), client.dropped());
    client.send(answer_);
  }
}

void StatusServer::publish_device(std::uint16_t port) {
  if (!watched(ReportClass::device, port)) return;
  answer_.clear();
  source_.append_device(answer_, port);
  answer_ += kLineEnd;
  publish(ReportClass::device, port, answer_);
}

void StatusServer::on_caught_up(StatusClient& client) {
  if (client.watches(ReportClass::health)) send_health(client);
}

std::uint64_t StatusServer::dropped() const {
  std::uint64_t sum = dropped_by_gone_;
  for (const auto& client : clients_) sum += client->dropped();
  return sum;
}

std::size_t StatusServer::queued_bytes() const {
  std::size_t sum = 0;
  for (const auto& client : clients_) sum += client->queued_bytes();
  return sum;
}

std::uint16_t StatusServer::port() const { return acceptor_.local_endpoint().port(); }

}  // namespace navcal::daemon

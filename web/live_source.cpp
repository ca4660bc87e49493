// SPDX-License-Identifier: Apache-2.0
#include "web/live_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/write.hpp>
#include <nlohmann/json.hpp>

#include "base/line_reader.h"
#include "ports/no_throw.h"
#include "record/json/json_members.h"

namespace navcal::web {
namespace asio = boost::asio;
using ports::kNoThrow;
namespace {

constexpr auto kRetry = std::chrono::milliseconds(500);
constexpr auto kConnectLimit = std::chrono::seconds(5);
/// navcald reports its health every few seconds even when no instrument speaks.
constexpr auto kSilence = std::chrono::seconds(30);
/// Upper limit of a line. A policy and a record are far shorter.
constexpr std::size_t kMaxLine = 1 << 20;
constexpr std::size_t kReadSize = 64 << 10;

std::string watch_request(const Demand& demand) {
  nlohmann::ordered_json policy{{"enable", true}, {"json", true}, {"classes", {"RECORD"}}};
  policy["topics"] = demand.all_topics ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(demand.topics);
  policy["rate_Hz"] = demand.rate_Hz && *demand.rate_Hz > 0 ? nlohmann::ordered_json{{"RECORD", *demand.rate_Hz}}
                                                            : nlohmann::ordered_json(nullptr);
  auto& topic_rates = policy["topic_rate_Hz"] = nullptr;
  for (const auto& [topic, rate_Hz] : demand.topic_rate_Hz) {
    topic_rates[topic] = rate_Hz ? nlohmann::ordered_json(*rate_Hz) : nlohmann::ordered_json(nullptr);
  }
  return "?WATCH=" + policy.dump() + ";\n";
}

}  // namespace

LiveSource::LiveSource(const asio::any_io_executor& executor, Settings settings, Hub& hub)
    : settings_(std::move(settings)), hub_(hub), socket_(executor), pause_(executor), silence_(executor) {}

void LiveSource::start() {
  hub_.on_demand([this](const Demand&) { ask(); });
  asio::co_spawn(
      socket_.get_executor(), [self = shared_from_this()] { return self->run(); }, asio::detached);
}

void LiveSource::stop() {
  stopped_ = true;
  hub_.on_demand({});
  boost::system::error_code ignored;
  socket_.close(ignored);
  pause_.cancel();
  silence_.cancel();
}

asio::awaitable<void> LiveSource::run() {
  while (!stopped_) {
    std::string problem = co_await connect();
    if (problem.empty()) {
      ++counters_.connections;
      asked_.clear();
      is_answer_due_ = false;
      topics_.clear();
      hub_.set_link({true, ""});
      ask();
      problem = co_await read_lines();
      boost::system::error_code ignored;
      socket_.close(ignored);
    }
    if (stopped_) co_return;
    hub_.set_link({false, std::move(problem)});
    pause_.expires_after(kRetry);
    co_await pause_.async_wait(kNoThrow);
  }
}

/// Empty when connected, otherwise the reason in words.
asio::awaitable<std::string> LiveSource::connect() {
  const std::string place = settings_.host + " port " + settings_.port;
  asio::ip::tcp::resolver resolver(socket_.get_executor());
  const auto [unknown, endpoints] = co_await resolver.async_resolve(settings_.host, settings_.port, kNoThrow);
  if (unknown) co_return fmt::format("navcald at {}: {}", place, unknown.message());
  silence_.expires_after(kConnectLimit);
  silence_.async_wait([self = shared_from_this()](boost::system::error_code error) {
    boost::system::error_code ignored;
    if (!error) self->socket_.close(ignored);
  });
  const auto [refused, endpoint] = co_await asio::async_connect(socket_, endpoints, kNoThrow);
  silence_.cancel();
  if (refused) co_return fmt::format("navcald at {}: {}", place, refused.message());
  boost::system::error_code ignored;
  socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
  co_return std::string();
}

/// Reads until the connection ends; the reason in words.
asio::awaitable<std::string> LiveSource::read_lines() {
  std::vector<char> chunk(kReadSize);
  silent_ = false;
  base::LineReader lines(kMaxLine);
  for (;;) {
    silence_.expires_after(kSilence);
    silence_.async_wait([self = shared_from_this()](boost::system::error_code error) {
      if (error) return;
      self->silent_ = true;
      boost::system::error_code ignored;
      self->socket_.cancel(ignored);
    });
    const auto [error, n] = co_await socket_.async_read_some(asio::buffer(chunk), kNoThrow);
    silence_.cancel();
    if (silent_) co_return fmt::format("navcald has said nothing for {} s", kSilence.count());
    if (error == asio::error::eof) co_return std::string("navcald closed the connection");
    if (error) co_return error.message();
    if (!lines.feed({chunk.data(), n}, [this](std::string_view line) { take(line); }))
      co_return std::string("the peer is not navcald: it sends no lines");
  }
}

void LiveSource::ask() {
  std::string wanted = watch_request(hub_.demand());
  if (!hub_.link().connected || is_answer_due_ || wanted == asked_) return;
  request_ = (asked_.empty() ? "?RECORDS;\n" : "") + wanted;
  asked_ = std::move(wanted);
  is_answer_due_ = true;
  // A failure ends the reading.
  asio::async_write(socket_, asio::buffer(request_),
                    [self = shared_from_this()](boost::system::error_code, std::size_t) {});
}

void LiveSource::take(std::string_view line) {
  ++counters_.lines;
  if (const auto record = read_record(line)) {
    if (record->topic == "/health") take_health(record->message);
    hub_.publish(*record);
  } else if (line.starts_with(R"({"class":"RECORDS")")) {
    take_topics(line);
  } else if (line.starts_with(R"({"class":"ERROR")")) {
    hub_.set_link({true, "navcald: " + std::string(line)});
    ++counters_.not_understood;
    is_answer_due_ = false;
    ask();
  } else if (line.starts_with(R"({"class":"WATCH")")) {
    is_answer_due_ = false;
    ask();
  } else if (!line.empty() && !line.starts_with(R"({"class":")")) {
    ++counters_.not_understood;
  }
}

/// Topics come in one line or several, of which each adds to those before it.
void LiveSource::take_topics(std::string_view line) {
  // Ordered, because a schema is handed on as the log has it.
  const auto answer = nlohmann::ordered_json::parse(line, nullptr, false);
  if (!answer.is_object() || !answer.contains("topics") || !answer["topics"].is_array()) {
    ++counters_.not_understood;
    return;
  }
  for (const auto& entry : answer["topics"]) {
    const std::string name = record::text_in(entry, "topic");
    if (name.empty() || !entry.contains("schema")) continue;
    Topic topic{name, record::text_in(entry, "schema_name"), entry["schema"].dump()};
    const auto same = [&](const Topic& other) { return other.name == topic.name; };
    if (std::none_of(topics_.begin(), topics_.end(), same)) topics_.push_back(std::move(topic));
  }
  hub_.set_topics(topics_);
}

/// navcald counts what it dropped for this client in the HEALTH that it sends once the client has caught up.
void LiveSource::take_health(std::string_view message) {
  const auto health = nlohmann::json::parse(message, nullptr, false);
  if (!health.is_object() || !health.contains("dropped")) return;
  const auto& dropped = health["dropped"];
  if (dropped.is_number_unsigned()) counters_.missed = dropped.get<std::uint64_t>();
}

std::optional<LiveSource::Settings> status_socket(std::string_view text) {
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  std::string_view host = text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  return LiveSource::Settings{host.empty() ? "127.0.0.1" : std::string(host), std::string(text.substr(colon + 1))};
}

}  // namespace navcal::web

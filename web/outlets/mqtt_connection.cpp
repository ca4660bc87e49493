// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mqtt_connection.h"

#include <dlfcn.h>

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdio>
#include <stdexcept>

#include "ports/no_throw.h"

namespace navcal::web {

MosquittoFunction mosquitto_function(const char* name) {
  static void* const library = ::dlopen("libmosquitto.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error("--mqtt needs libmosquitto1 (apt install libmosquitto1)");
  void* const found = ::dlsym(library, (std::string("mosquitto_") + name).c_str());
  if (found == nullptr) throw std::runtime_error(std::string("--mqtt: libmosquitto has no mosquitto_") + name);
  return {found};
}

namespace asio = boost::asio;
using ports::kNoThrow;

namespace {

constexpr auto kMqttRetry = std::chrono::seconds(1);
constexpr auto kMqttTick = std::chrono::milliseconds(100);
/// A broker that says nothing for one and a half times this is gone, and so is this program for the broker.
constexpr int kKeepAlive_s = 10;

}  // namespace

MqttConnection::MqttConnection(const asio::any_io_executor& executor, MqttBroker broker, MqttLogin login,
                               std::string will)
    : broker_(std::move(broker)), will_(std::move(will)), timer_(executor) {
  static const int kBegun = decltype(&mosquitto_lib_init)(mosquitto_function("lib_init"))();
  client_ = kBegun == MOSQ_ERR_SUCCESS ? library_.create(nullptr, true, this) : nullptr;
  if (client_ == nullptr) throw std::runtime_error("--mqtt: no memory");
  library_.will_set(client_, will_.c_str(), 1, "0", 1, true);
  if (!login.user.empty()) library_.login_set(client_, login.user.c_str(), login.password.c_str());
  library_.on_connect(
      client_, [](mosquitto*, void* self, int code) { static_cast<MqttConnection*>(self)->accepted(code); });
  library_.on_publish(client_, [](mosquitto*, void* self, int message_id) {
    static_cast<MqttConnection*>(self)->done(message_id);
  });
}

MqttConnection::~MqttConnection() { library_.destroy(client_); }

void MqttConnection::start(std::function<void()> on_connected, std::function<void()> on_tick) {
  on_connected_ = std::move(on_connected);
  on_tick_ = std::move(on_tick);
  asio::co_spawn(
      timer_.get_executor(), [self = shared_from_this()] { return self->run(); }, asio::detached);
}

void MqttConnection::stop() {
  if (stopped_) return;
  if (counters_.connected) {
    // A good-bye keeps the broker from publishing the will.
    library_.publish(client_, nullptr, will_.c_str(), 1, "0", 1, true);
    library_.disconnect(client_);
  }
  stopped_ = true;
  timer_.cancel();
}

asio::awaitable<void> MqttConnection::run() {
  while (!stopped_) {
    const std::string problem = co_await serve();
    if (stopped_) co_return;
    if (problem != told_problem_)
      std::fprintf(stderr, "navcal-web: MQTT broker %s: %s\n", broker_.host.c_str(), problem.c_str());
    told_problem_ = problem;
    timer_.expires_after(kMqttRetry);
    co_await timer_.async_wait(kNoThrow);
  }
}

asio::awaitable<std::string> MqttConnection::serve() {
  asio::ip::tcp::resolver resolver(timer_.get_executor());
  const auto [unknown, endpoints] = co_await resolver.async_resolve(broker_.host, broker_.port, kNoThrow);
  if (unknown) co_return unknown.message();
  const auto endpoint = endpoints.begin()->endpoint();
  // An address and no name: libmosquitto would wait for the name server.
  const std::string address = endpoint.address().to_string();
  refusal_.clear();
  int result = library_.connect(client_, address.c_str(), endpoint.port(), kKeepAlive_s);
  while (result == MOSQ_ERR_SUCCESS && !stopped_) {
    timer_.expires_after(kMqttTick);
    co_await timer_.async_wait(kNoThrow);
    if (stopped_) co_return std::string();
    result = library_.loop(client_, 0, 1);
    if (std::exchange(is_greeting_due_, false)) on_connected_();
    on_tick_();
  }
  ended();
  co_return refusal_.empty() ? library_.text_of_error(result) : refusal_;
}

bool MqttConnection::publish(const std::string& topic, std::string_view message, Quality quality,
                             bool is_retained) {
  const std::size_t bytes = topic.size() + message.size();
  const bool is_lossy = quality == Quality::at_most_once;
  if ((is_lossy && !counters_.connected) || waiting_bytes_ + bytes > kMaxWaiting_bytes || stopped_) {
    ++counters_.dropped;
    return false;
  }
  int id = 0;
  done_at_once_.clear();
  const int result = library_.publish(client_, &id, topic.c_str(), static_cast<int>(message.size()),
                                      message.data(), static_cast<int>(quality), is_retained);
  const bool was_taken = result == MOSQ_ERR_SUCCESS || (result == MOSQ_ERR_NO_CONN && !is_lossy);
  if (!was_taken) {
    ++counters_.dropped;
  } else if (std::find(done_at_once_.begin(), done_at_once_.end(), id) == done_at_once_.end()) {
    waiting_[id] = {bytes, is_lossy};
    waiting_bytes_ += bytes;
  }
  return was_taken;
}

void MqttConnection::accepted(int code) {
  if (code != 0) {
    refusal_ = library_.text_of_refusal(code);
    return;
  }
  counters_.connected = true;
  told_problem_.clear();
  // Called by libmosquitto, which must not be called back from here.
  is_greeting_due_ = true;
}

void MqttConnection::done(int message_id) {
  ++counters_.published;
  const auto found = waiting_.find(message_id);
  if (found == waiting_.end()) {
    done_at_once_.push_back(message_id);
    return;
  }
  waiting_bytes_ -= found->second.bytes;
  waiting_.erase(found);
}

void MqttConnection::ended() {
  counters_.connected = false;
  for (auto one = waiting_.begin(); one != waiting_.end();) {
    if (!one->second.is_lost_with_connection) {
      ++one;
      continue;
    }
    waiting_bytes_ -= one->second.bytes;
    ++counters_.dropped;
    one = waiting_.erase(one);
  }
}

}  // namespace navcal::web

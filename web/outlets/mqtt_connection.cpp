// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mqtt_connection.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdio>
#include <stdexcept>

#include "ports/no_throw.h"

namespace navcal::web {
namespace {

template <class Function>
void find_function(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  if (function == nullptr) throw std::runtime_error(std::string("--mqtt: libmosquitto has no ") + name);
}

MosquittoLibrary load_mosquitto() {
  void* library = ::dlopen("libmosquitto.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error("--mqtt needs libmosquitto1 (apt install libmosquitto1)");
  MosquittoLibrary found;
  find_function(library, "mosquitto_new", found.create);
  find_function(library, "mosquitto_destroy", found.destroy);
  find_function(library, "mosquitto_will_set", found.will_set);
  find_function(library, "mosquitto_username_pw_set", found.login_set);
  find_function(library, "mosquitto_connect_callback_set", found.on_connect);
  find_function(library, "mosquitto_publish_callback_set", found.on_publish);
  find_function(library, "mosquitto_connect_async", found.connect);
  find_function(library, "mosquitto_disconnect", found.disconnect);
  find_function(library, "mosquitto_publish", found.publish);
  find_function(library, "mosquitto_loop_read", found.loop_read);
  find_function(library, "mosquitto_loop_write", found.loop_write);
  find_function(library, "mosquitto_loop_misc", found.loop_misc);
  find_function(library, "mosquitto_socket", found.socket);
  find_function(library, "mosquitto_want_write", found.want_write);
  find_function(library, "mosquitto_strerror", found.text_of_error);
  find_function(library, "mosquitto_connack_string", found.text_of_refusal);
  decltype(&mosquitto_lib_init) begin = nullptr;
  find_function(library, "mosquitto_lib_init", begin);
  begin();
  return found;
}

}  // namespace

const MosquittoLibrary& MosquittoLibrary::instance() {
  static const MosquittoLibrary kLibrary = load_mosquitto();
  return kLibrary;
}

namespace asio = boost::asio;
using ports::kNoThrow;

namespace {

using Socket = std::shared_ptr<asio::posix::stream_descriptor>;

constexpr auto kMqttRetry = std::chrono::seconds(1);
constexpr auto kMqttTick = std::chrono::seconds(1);
/// A broker that says nothing for one and a half times this is gone, and so is this program for the broker.
constexpr int kKeepAlive_s = 10;
constexpr int kMaxPackets = 64;

}  // namespace

MqttConnection::MqttConnection(const asio::any_io_executor& executor, MqttBroker broker, MqttLogin login,
                               std::string will)
    : library_(MosquittoLibrary::instance()), broker_(std::move(broker)), will_(std::move(will)),
      client_(library_.create(nullptr, true, this)), timer_(executor) {
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

void MqttConnection::start(std::function<void()> on_connected) {
  on_connected_ = std::move(on_connected);
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
  on_connected_ = nullptr;
  ended("");
  timer_.cancel();
}

asio::awaitable<void> MqttConnection::run() {
  while (!stopped_) {
    std::string problem = co_await connect();
    if (stopped_) co_return;
    if (problem.empty()) {
      co_await keep_alive();
      if (stopped_) co_return;
      problem = problem_;
    }
    if (problem != told_problem_)
      std::fprintf(stderr, "navcal-web: MQTT broker %s: %s\n", broker_.host.c_str(), problem.c_str());
    told_problem_ = problem;
    timer_.expires_after(kMqttRetry);
    co_await timer_.async_wait(kNoThrow);
  }
}

asio::awaitable<std::string> MqttConnection::connect() {
  asio::ip::tcp::resolver resolver(timer_.get_executor());
  const auto [unknown, endpoints] = co_await resolver.async_resolve(broker_.host, broker_.port, kNoThrow);
  if (unknown) co_return unknown.message();
  if (stopped_) co_return std::string();
  const auto endpoint = endpoints.begin()->endpoint();
  // An address and no name: libmosquitto would wait for the name server.
  const std::string address = endpoint.address().to_string();
  const int result = library_.connect(client_, address.c_str(), endpoint.port(), kKeepAlive_s);
  if (result != MOSQ_ERR_SUCCESS) co_return std::string(library_.text_of_error(result));
  // A copy, because libmosquitto closes its own whenever it likes.
  const int copy = ::dup(library_.socket(client_));
  if (copy < 0) co_return std::string("no more descriptors");
  problem_.clear();
  socket_ = std::make_shared<asio::posix::stream_descriptor>(timer_.get_executor(), copy);
  asio::co_spawn(
      timer_.get_executor(), [self = shared_from_this(), socket = socket_] { return self->read(socket); },
      asio::detached);
  write_soon();
  co_return std::string();
}

/// Until the connection ends.
asio::awaitable<void> MqttConnection::keep_alive() {
  while (socket_) {
    timer_.expires_after(kMqttTick);
    co_await timer_.async_wait(kNoThrow);
    if (!socket_) co_return;
    check(library_.loop_misc(client_));
    write_soon();
  }
}

asio::awaitable<void> MqttConnection::read(Socket socket) {
  while (socket == socket_) {
    const auto [error] = co_await socket->async_wait(asio::posix::stream_descriptor::wait_read, kNoThrow);
    if (error || socket != socket_) co_return;
    check(library_.loop_read(client_, kMaxPackets));
    if (std::exchange(is_greeting_due_, false) && on_connected_) on_connected_();
    write_soon();
  }
}

void MqttConnection::write_soon() {
  if (!socket_ || is_writing_ || !library_.want_write(client_)) return;
  is_writing_ = true;
  asio::co_spawn(
      timer_.get_executor(), [self = shared_from_this(), socket = socket_] { return self->write(socket); },
      asio::detached);
}

asio::awaitable<void> MqttConnection::write(Socket socket) {
  while (socket == socket_ && library_.want_write(client_)) {
    const auto [error] = co_await socket->async_wait(asio::posix::stream_descriptor::wait_write, kNoThrow);
    if (error || socket != socket_) co_return;
    check(library_.loop_write(client_, kMaxPackets));
  }
  if (socket == socket_) is_writing_ = false;
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
  write_soon();
  return was_taken;
}

void MqttConnection::check(int result) {
  if (result == MOSQ_ERR_SUCCESS || !socket_) return;
  if (problem_.empty()) problem_ = library_.text_of_error(result);
  ended(problem_);
}

void MqttConnection::accepted(int code) {
  if (code != 0) {
    problem_ = library_.text_of_refusal(code);
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

void MqttConnection::ended(const std::string& why) {
  problem_ = why;
  counters_.connected = false;
  is_writing_ = false;
  is_greeting_due_ = false;
  if (socket_) {
    boost::system::error_code ignored;
    socket_->close(ignored);
    socket_.reset();
  }
  for (auto one = waiting_.begin(); one != waiting_.end();) {
    if (!one->second.is_lost_with_connection) {
      ++one;
      continue;
    }
    waiting_bytes_ -= one->second.bytes;
    ++counters_.dropped;
    one = waiting_.erase(one);
  }
  timer_.cancel();
}

}  // namespace navcal::web

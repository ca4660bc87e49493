// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mosquitto.h>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "web/outlets/mqtt_topics.h"

namespace navcal::web {

struct MosquittoFunction {
  void* address;
  template <class Function>
  operator Function*() const {  // NOLINT(google-explicit-constructor): of the type that mosquitto.h gives it
    return reinterpret_cast<Function*>(address);
  }
};
/// mosquitto_NAME. Loads libmosquitto; throws std::runtime_error, which says what to install, when it is not
/// there.
[[nodiscard]] MosquittoFunction mosquitto_function(const char* name);

/// The functions of libmosquitto that are in use. The library is loaded only when they are: with it come OpenSSL's
/// libraries, which cost a server without MQTT memory for nothing.
struct MosquittoLibrary {
  decltype(&mosquitto_new) create = mosquitto_function("new");
  decltype(&mosquitto_destroy) destroy = mosquitto_function("destroy");
  decltype(&mosquitto_will_set) will_set = mosquitto_function("will_set");
  decltype(&mosquitto_username_pw_set) login_set = mosquitto_function("username_pw_set");
  decltype(&mosquitto_connect_callback_set) on_connect = mosquitto_function("connect_callback_set");
  decltype(&mosquitto_publish_callback_set) on_publish = mosquitto_function("publish_callback_set");
  decltype(&mosquitto_connect_async) connect = mosquitto_function("connect_async");
  decltype(&mosquitto_disconnect) disconnect = mosquitto_function("disconnect");
  decltype(&mosquitto_publish) publish = mosquitto_function("publish");
  decltype(&mosquitto_loop) loop = mosquitto_function("loop");
  decltype(&mosquitto_strerror) text_of_error = mosquitto_function("strerror");
  decltype(&mosquitto_connack_string) text_of_refusal = mosquitto_function("connack_string");
};

struct MqttLogin {
  std::string user, password;
};

struct MqttCounters {
  bool connected = false;
  std::uint64_t published = 0;  ///< that the broker has, or that were written to its connection
  std::uint64_t dropped = 0;    ///< because there was no broker, or because it was too slow
};

/// One connection to a broker, which is made again when it ends. libmosquitto writes a message when it gets it,
/// and ten times a second what was left, and reads the answers: no thread, and nothing waits. What the broker does
/// not take is kept up to a bound, then dropped.
class MqttConnection : public std::enable_shared_from_this<MqttConnection> {
 public:
  enum class Quality : int { at_most_once = 0, at_least_once = 1 };
  static constexpr std::size_t kMaxWaiting_bytes = 1 << 20;

  /// The broker publishes `will` with "0", retained, when this program goes without a word.
  /// Throws std::runtime_error when libmosquitto is not there.
  MqttConnection(const boost::asio::any_io_executor& executor, MqttBroker broker, MqttLogin login,
                 std::string will);
  ~MqttConnection();
  MqttConnection(const MqttConnection&) = delete;
  MqttConnection& operator=(const MqttConnection&) = delete;

  /// `on_connected` is called each time that the broker has accepted, `on_tick` ten times a second while there is
  /// a connection; neither after stop().
  void start(std::function<void()> on_connected, std::function<void()> on_tick);
  void stop();
  /// False when it was dropped. At least once: also waits for a broker that is away.
  bool publish(const std::string& topic, std::string_view message, Quality quality, bool is_retained);
  [[nodiscard]] const MqttCounters& counters() const { return counters_; }

 private:
  boost::asio::awaitable<void> run();
  /// Until the connection has ended; the reason in words.
  boost::asio::awaitable<std::string> serve();
  void accepted(int code);
  void done(int message_id);
  void ended();

  MosquittoLibrary library_;
  MqttBroker broker_;
  std::string will_;
  mosquitto* client_ = nullptr;
  boost::asio::steady_timer timer_;
  std::function<void()> on_connected_, on_tick_;
  struct Waiting {
    std::size_t bytes;
    bool is_lost_with_connection;
  };
  std::map<int, Waiting> waiting_;  ///< by number of the message
  std::size_t waiting_bytes_ = 0;
  std::vector<int> done_at_once_;  ///< messages that were written while they were handed over
  std::string refusal_, told_problem_;
  MqttCounters counters_;
  bool is_greeting_due_ = false;
  bool stopped_ = false;
};

}  // namespace navcal::web

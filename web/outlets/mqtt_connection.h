// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mosquitto.h>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
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

/// The functions of libmosquitto that are in use. The library is loaded only when they are: with it come OpenSSL's
/// libraries, which cost a server without MQTT memory for nothing.
struct MosquittoLibrary {
  decltype(&mosquitto_new) create = nullptr;
  decltype(&mosquitto_destroy) destroy = nullptr;
  decltype(&mosquitto_will_set) will_set = nullptr;
  decltype(&mosquitto_username_pw_set) login_set = nullptr;
  decltype(&mosquitto_connect_callback_set) on_connect = nullptr;
  decltype(&mosquitto_publish_callback_set) on_publish = nullptr;
  decltype(&mosquitto_connect_async) connect = nullptr;
  decltype(&mosquitto_disconnect) disconnect = nullptr;
  decltype(&mosquitto_publish) publish = nullptr;
  decltype(&mosquitto_loop_read) loop_read = nullptr;
  decltype(&mosquitto_loop_write) loop_write = nullptr;
  decltype(&mosquitto_loop_misc) loop_misc = nullptr;
  decltype(&mosquitto_socket) socket = nullptr;
  decltype(&mosquitto_want_write) want_write = nullptr;
  decltype(&mosquitto_strerror) text_of_error = nullptr;
  decltype(&mosquitto_connack_string) text_of_refusal = nullptr;

  /// Loads the library once. Throws std::runtime_error, which says what to install, when it is not there.
  [[nodiscard]] static const MosquittoLibrary& instance();
};

struct MqttLogin {
  std::string user, password;
};

struct MqttCounters {
  bool connected = false;
  std::uint64_t published = 0;  ///< that the broker has, or that were written to its connection
  std::uint64_t dropped = 0;    ///< because there was no broker, or because it was too slow
};

/// One connection to a broker, which is made again when it ends. libmosquitto's socket is driven by the loop of
/// this program: no thread, and nothing waits. What the broker does not take is kept up to a bound, then dropped.
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

  /// `on_connected` is called each time that the broker has accepted.
  void start(std::function<void()> on_connected);
  void stop();
  /// False when it was dropped. At least once: also waits for a broker that is away.
  bool publish(const std::string& topic, std::string_view message, Quality quality, bool is_retained);
  [[nodiscard]] const MqttCounters& counters() const { return counters_; }

 private:
  boost::asio::awaitable<void> run();
  /// Empty when libmosquitto has a socket, otherwise the reason in words.
  boost::asio::awaitable<std::string> connect();
  boost::asio::awaitable<void> read(std::shared_ptr<boost::asio::posix::stream_descriptor> socket);
  boost::asio::awaitable<void> write(std::shared_ptr<boost::asio::posix::stream_descriptor> socket);
  boost::asio::awaitable<void> keep_alive();
  void write_soon();
  void check(int result);
  void accepted(int code);
  void done(int message_id);
  void ended(const std::string& why);

  const MosquittoLibrary& library_;
  MqttBroker broker_;
  std::string will_;
  mosquitto* client_;
  boost::asio::steady_timer timer_;
  std::shared_ptr<boost::asio::posix::stream_descriptor> socket_;  ///< a copy of libmosquitto's
  std::function<void()> on_connected_;
  struct Waiting {
    std::size_t bytes;
    bool is_lost_with_connection;
  };
  std::map<int, Waiting> waiting_;  ///< by number of the message
  std::size_t waiting_bytes_ = 0;
  std::vector<int> done_at_once_;  ///< messages that were written while they were handed over
  std::string problem_;
  std::string told_problem_;
  MqttCounters counters_;
  bool is_writing_ = false;
  bool is_greeting_due_ = false;
  bool stopped_ = false;
};

}  // namespace navcal::web

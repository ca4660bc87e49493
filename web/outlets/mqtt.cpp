// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mqtt.h"

#include <dlfcn.h>
#include <mosquitto.h>

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "web/access.h"
#include "web/outlets/mqtt_topics.h"
#include "web/outlets/pacer.h"

namespace navcal::web {
namespace {

namespace asio = boost::asio;

struct MosquittoFunction {
  void* address;
  template <class Function>
  operator Function*() const {  // NOLINT(google-explicit-constructor): of the type that mosquitto.h gives it
    return reinterpret_cast<Function*>(address);
  }
};

/// mosquitto_NAME. Loads libmosquitto; throws std::runtime_error, which says what to install, when it is not
/// there.
MosquittoFunction mosquitto_function(const char* name) {
  static void* const library = ::dlopen("libmosquitto.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error("--mqtt needs libmosquitto1 (apt install libmosquitto1)");
  void* const found = ::dlsym(library, (std::string("mosquitto_") + name).c_str());
  if (found == nullptr) throw std::runtime_error(std::string("--mqtt: libmosquitto has no mosquitto_") + name);
  return {found};
}

/// The functions of libmosquitto that are in use. The library is loaded only when they are: with it come OpenSSL's
/// libraries, which cost a server without MQTT memory for nothing.
struct MosquittoLibrary {
  decltype(&mosquitto_lib_init) begin = mosquitto_function("lib_init");
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

constexpr auto kMqttRetry = std::chrono::seconds(1);
constexpr auto kMqttTick = std::chrono::milliseconds(100);
/// A broker that says nothing for one and a half times this is gone, and so is this program for the broker.
constexpr int kKeepAlive_s = 10;
constexpr std::size_t kMaxUnsent_bytes = 1 << 20;
/// More topics than a vehicle has.
constexpr std::size_t kMaxMqttTopics = 1024;

enum class Quality : int { at_most_once = 0, at_least_once = 1 };

/// One connection, which is made again when it ends. libmosquitto writes a message when it gets it, and ten times
/// a second what was left, and reads the answers: no thread, and nothing waits. What the broker does not take is
/// kept up to a bound, then dropped.
class Mqtt final : public Subscriber {
 public:
  Mqtt(const asio::any_io_executor& executor, const MqttOptions& options, Hub& hub, MqttCounters& counters)
      : options_(options), hub_(hub), counters_(counters), resolver_(executor), timer_(executor),
        will_(options.prefix + "/online"), interval_(Pacer::interval_of(options.rate_Hz)) {
    const auto broker = mqtt_broker(options.broker);
    if (!broker) throw std::runtime_error("--mqtt: wants HOST or HOST:PORT, not \"" + options.broker + "\"");
    broker_ = *broker;
    const MqttLogin login = options.login_file.empty() ? MqttLogin() : read_mqtt_login(options.login_file);
    library_.begin();
    client_ = library_.create(nullptr, true, this);
    if (client_ == nullptr) throw std::runtime_error("--mqtt: no memory");
    // The broker publishes it when this program goes without a word.
    library_.will_set(client_, will_.c_str(), 1, "0", 1, true);
    if (!login.user.empty()) library_.login_set(client_, login.user.c_str(), login.password.c_str());
    library_.on_connect(client_,
                        [](mosquitto*, void* self, int code) { static_cast<Mqtt*>(self)->accepted(code); });
    library_.on_publish(client_, [](mosquitto*, void* self, int id) { static_cast<Mqtt*>(self)->done(id); });
    hub_.add(*this, {true, {}, options_.rate_Hz});
    connect();
  }
  ~Mqtt() override {
    hub_.remove(*this);
    if (counters_.connected) {
      // A good-bye keeps the broker from publishing the will.
      library_.publish(client_, nullptr, will_.c_str(), 1, "0", 1, true);
      library_.disconnect(client_);
    }
    library_.destroy(client_);
  }
  Mqtt(const Mqtt&) = delete;
  Mqtt& operator=(const Mqtt&) = delete;

  void on_record(const Record& record) override {
    const auto place = mqtt_place(options_.prefix, record);
    if (!place) return;
    if (place->is_event) return publish(place->topic, record.message, Quality::at_least_once, false);
    if (!counters_.connected) return;  // the newest follows with the greeting
    auto found = states_.find(place->topic);
    if (found == states_.end()) {
      if (states_.size() >= kMaxMqttTopics) return;
      found = states_.emplace(place->topic, State()).first;
    }
    State& state = found->second;
    if (state.pacer.pass(Pacer::Clock::now(), interval_)) {
      state.waiting.clear();
      publish(place->topic, record.message, Quality::at_most_once, true);
    } else {
      state.waiting.assign(record.message);
    }
  }
  void on_link(const Link& link) override {
    publish(options_.prefix + "/navcald", link.connected ? "1" : "0", Quality::at_least_once, true);
  }

 private:
  struct State {
    Pacer pacer;
    std::string waiting;  ///< the newest, while its time has not come; empty otherwise
  };
  struct Waiting {
    std::size_t bytes;
    bool is_lost_with_connection;
  };

  void after(std::chrono::milliseconds pause, void (Mqtt::*step)()) {
    timer_.expires_after(pause);
    timer_.async_wait([this, step](boost::system::error_code error) {
      if (!error) (this->*step)();
    });
  }
  void connect() {
    resolver_.async_resolve(
        broker_.host, broker_.port,
        [this](boost::system::error_code error, const asio::ip::tcp::resolver::results_type& endpoints) {
          if (error == asio::error::operation_aborted) return;
          if (error) return ended(error.message());
          const auto endpoint = endpoints.begin()->endpoint();
          // An address and no name: libmosquitto would wait for the name server.
          const std::string address = endpoint.address().to_string();
          refusal_.clear();
          const int result = library_.connect(client_, address.c_str(), endpoint.port(), kKeepAlive_s);
          if (result != MOSQ_ERR_SUCCESS) return ended(library_.text_of_error(result));
          after(kMqttTick, &Mqtt::tick);
        });
  }
  void tick() {
    const int result = library_.loop(client_, 0, 1);
    if (std::exchange(is_greeting_due_, false)) greet();
    if (result != MOSQ_ERR_SUCCESS) return ended(refusal_.empty() ? library_.text_of_error(result) : refusal_);
    // A state that came too early is sent when its time has come, so that the broker has the newest also of a
    // device that then fell silent.
    const auto now = Pacer::Clock::now();
    for (auto& [topic, state] : states_) {
      if (state.waiting.empty() || !state.pacer.pass(now, interval_)) continue;
      publish(topic, std::exchange(state.waiting, {}), Quality::at_most_once, true);
    }
    after(kMqttTick, &Mqtt::tick);
  }
  void ended(const std::string& problem) {
    counters_.connected = false;
    std::erase_if(waiting_, [this](const auto& one) {
      if (!one.second.is_lost_with_connection) return false;
      waiting_bytes_ -= one.second.bytes;
      ++counters_.dropped;
      return true;
    });
    if (problem != told_problem_)
      std::fprintf(stderr, "navcal-web: MQTT broker %s: %s\n", broker_.host.c_str(), problem.c_str());
    told_problem_ = problem;
    after(kMqttRetry, &Mqtt::connect);
  }
  /// The broker may have forgotten everything: it gets the newest of all states again.
  void greet() {
    publish(will_, "1", Quality::at_least_once, true);
    states_.clear();
    on_link(hub_.link());
    hub_.repeat_newest([this](const Record& record) {
      const auto place = mqtt_place(options_.prefix, record);
      if (place && !place->is_event) on_record(record);
    });
  }
  /// At least once: also waits for a broker that is away.
  void publish(const std::string& topic, std::string_view message, Quality quality, bool is_retained) {
    const std::size_t bytes = topic.size() + message.size();
    const bool is_lossy = quality == Quality::at_most_once;
    if ((is_lossy && !counters_.connected) || waiting_bytes_ + bytes > kMaxUnsent_bytes) {
      ++counters_.dropped;
      return;
    }
    int id = 0;
    done_at_once_.clear();
    const int result = library_.publish(client_, &id, topic.c_str(), static_cast<int>(message.size()),
                                        message.data(), static_cast<int>(quality), is_retained);
    if (result != MOSQ_ERR_SUCCESS && (result != MOSQ_ERR_NO_CONN || is_lossy)) {
      ++counters_.dropped;
    } else if (std::find(done_at_once_.begin(), done_at_once_.end(), id) == done_at_once_.end()) {
      waiting_[id] = {bytes, is_lossy};
      waiting_bytes_ += bytes;
    }
  }
  void accepted(int code) {
    if (code != 0) {
      refusal_ = library_.text_of_refusal(code);
      return;
    }
    counters_.connected = true;
    told_problem_.clear();
    // Called by libmosquitto, which must not be called back from here.
    is_greeting_due_ = true;
  }
  void done(int message_id) {
    ++counters_.published;
    const auto found = waiting_.find(message_id);
    if (found == waiting_.end()) {
      done_at_once_.push_back(message_id);
      return;
    }
    waiting_bytes_ -= found->second.bytes;
    waiting_.erase(found);
  }

  MosquittoLibrary library_;
  MqttOptions options_;
  Hub& hub_;
  MqttCounters& counters_;
  asio::ip::tcp::resolver resolver_;
  asio::steady_timer timer_;
  MqttBroker broker_;
  std::string will_;
  Pacer::Clock::duration interval_;
  mosquitto* client_ = nullptr;
  std::map<std::string, State, std::less<>> states_;  ///< by topic
  std::map<int, Waiting> waiting_;                    ///< by number of the message
  std::size_t waiting_bytes_ = 0;
  std::vector<int> done_at_once_;  ///< messages that were written while they were handed over
  std::string refusal_, told_problem_;
  bool is_greeting_due_ = false;
};

}  // namespace

std::unique_ptr<Subscriber> make_mqtt(const asio::any_io_executor& executor, const MqttOptions& options, Hub& hub,
                                      MqttCounters& counters) {
  return std::make_unique<Mqtt>(executor, options, hub, counters);
}

MqttLogin read_mqtt_login(const std::filesystem::path& file) {
  std::ifstream in = open_secret(file);
  MqttLogin login;
  if (!std::getline(in, login.user) || !std::getline(in, login.password) || login.user.empty())
    throw std::runtime_error(file.string() + ": wants the user in the first line and the password in the second");
  return login;
}

}  // namespace navcal::web

// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mqtt.h"

#include <fstream>
#include <stdexcept>
#include <utility>

#include "web/access.h"

namespace navcal::web {
namespace {

using Quality = MqttConnection::Quality;

/// More topics than a vehicle has.
constexpr std::size_t kMaxMqttTopics = 1024;

}  // namespace

Mqtt::Mqtt(const boost::asio::any_io_executor& executor, const MqttOptions& options, Hub& hub)
    : options_(options), hub_(hub), interval_(Pacer::interval_of(options.rate_Hz)) {
  const auto broker = mqtt_broker(options.broker);
  if (!broker) throw std::runtime_error("--mqtt: wants HOST or HOST:PORT, not \"" + options.broker + "\"");
  const MqttLogin login = options.login_file.empty() ? MqttLogin() : read_mqtt_login(options.login_file);
  connection_ = std::make_shared<MqttConnection>(executor, *broker, login, options.prefix + "/online");
  hub_.add(*this, {true, {}, options_.rate_Hz});
  connection_->start([this] { greet(); }, [this] { send_due(); });
}

void Mqtt::stop() {
  hub_.remove(*this);
  connection_->stop();
}

/// The broker may have forgotten everything: it gets the newest of all states again.
void Mqtt::greet() {
  connection_->publish(options_.prefix + "/online", "1", Quality::at_least_once, true);
  states_.clear();
  tell_link(hub_.link().connected);
  struct States final : Subscriber {
    explicit States(Mqtt& mqtt) : mqtt_(mqtt) {}
    void on_record(const Record& record) override {
      const auto place = mqtt_place(mqtt_.options_.prefix, record);
      if (place && !place->is_event) mqtt_.on_record(record);
    }
    Mqtt& mqtt_;
  } states(*this);
  hub_.repeat_newest(states);
}

void Mqtt::on_record(const Record& record) {
  const auto place = mqtt_place(options_.prefix, record);
  if (!place) return;
  if (place->is_event) {
    connection_->publish(place->topic, record.message, Quality::at_least_once, false);
    return;
  }
  if (!connection_->counters().connected) return;  // the newest follows with the greeting
  auto found = states_.find(place->topic);
  if (found == states_.end()) {
    if (states_.size() >= kMaxMqttTopics) return;
    found = states_.emplace(place->topic, State()).first;
  }
  State& state = found->second;
  if (state.pacer.pass(Pacer::Clock::now(), interval_)) {
    state.waiting.clear();
    connection_->publish(place->topic, record.message, Quality::at_most_once, true);
  } else {
    state.waiting.assign(record.message);
  }
}

void Mqtt::on_link(const Link& link) { tell_link(link.connected); }

void Mqtt::tell_link(bool is_up) {
  connection_->publish(options_.prefix + "/navcald", is_up ? "1" : "0", Quality::at_least_once, true);
}

/// A state that came too early is sent when its time has come, so that the broker has the newest also of a device
/// that then fell silent.
void Mqtt::send_due() {
  const auto now = Pacer::Clock::now();
  for (auto& [topic, state] : states_) {
    if (state.waiting.empty() || !state.pacer.pass(now, interval_)) continue;
    connection_->publish(topic, std::exchange(state.waiting, {}), Quality::at_most_once, true);
  }
}

MqttLogin read_mqtt_login(const std::filesystem::path& file) {
  std::ifstream in = open_secret(file);
  MqttLogin login;
  if (!std::getline(in, login.user) || !std::getline(in, login.password) || login.user.empty())
    throw std::runtime_error(file.string() + ": wants the user in the first line and the password in the second");
  return login;
}

}  // namespace navcal::web

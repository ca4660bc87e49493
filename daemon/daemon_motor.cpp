// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <boost/asio/post.hpp>

#include "daemon/daemon.h"
#include "record/json/message_json.h"

namespace navcal::daemon {

// Orders to the motor card, and the state that controllers answer with them.
void Daemon::control_client_gone(std::uint64_t client, std::string_view reason) {
  if (motor_) motor_->client_gone(client, std::string(reason));
}

void Daemon::on_motor_event(std::int64_t now_ns, std::string_view severity, std::string_view name,
                            std::string_view message) {
  event(now_ns, severity, name, settings_.ports[*motor_port_].name, message);
}

void Daemon::on_motor_deaf(std::int64_t now_ns, bool is_deaf) {
  set_alarm(*motor_port_, Alarm::command_not_echoed, is_deaf, now_ns);
}

void Daemon::on_motor_unnoted(std::int64_t now_ns, bool is_unnoted) {
  set_alarm(*motor_port_, Alarm::orders_refused, is_unnoted, now_ns);
}

void Daemon::react_to_leaks(const std::vector<Alarms::Change>& changes, std::int64_t now_ns) {
  const auto is_leak = [](Alarm alarm) { return alarm == Alarm::leak_forward || alarm == Alarm::leak_aft; };
  bool changed = false;
  for (const auto& change : changes) {
    if (!is_leak(change.alarm)) continue;
    changed = true;
    if (change.raised) motor_->leak(now_ns, std::string(name_of(change.alarm)));
  }
  const auto& standing = alarms_.standing();
  const bool stands = std::ranges::any_of(standing, [&](const auto& alarm) { return is_leak(alarm.alarm); });
  if (changed && !stands) motor_->leak(now_ns, {});
}

void Daemon::ring_state() {
  const std::int64_t now_ns = ports::monotonic_ns();
  if (now_ns >= server_.next_state_ns()) server_.publish_state(state_report(now_ns), now_ns, false);
  state_timer_.arm(server_.next_state_ns());
}

VehicleState Daemon::vehicle_state(std::int64_t now_ns) {
  VehicleState state = state_.at(now_ns);
  for (const auto& standing : alarms_.standing()) state.alarms.push_back(name_of(standing.alarm));
  if (motor_) {
    const auto& command = motor_->command();
    if (const auto& holder = command.holder()) {
      state.holder = holder->name;
      state.priority = holder->priority;
      state.expires_in_s = static_cast<double>(holder->expires_ns - now_ns) * 1e-9;
    }
    state.order_sequence = command.sequence();
    state.order_late_s = motor_->late_s();
  }
  return state;
}

const std::string& Daemon::state_report(std::int64_t now_ns) {
  state_report_.clear();
  append_state(state_report_, vehicle_state(now_ns));
  return state_report_;
}

// The remote link and the vehicle.
link::Report Daemon::remote_report(std::int64_t now_ns) {
  return remote_report_.of(vehicle_state(now_ns), pipeline_, now_ns);
}

void Daemon::remote_answer(const ControlRequest& request, const ControlOrigin& origin, Reply reply) {
  ControlAnswer made = answer(request, origin);
  if (!made.work) return reply(made.text);
  // The disk may be slow, and the I/O thread waits for nothing.
  if (!remote_reader_) remote_reader_.emplace(2);
  boost::asio::post(*remote_reader_, [io = executor_, work = std::move(made.work), then = std::move(made.then),
                                      reply = std::move(reply)] {
    std::string line;
    try {
      line = work();
    } catch (const std::exception& error) {
      line = control_error(error.what());
    }
    boost::asio::post(io, [line = std::move(line), then, reply] { reply(then ? then(line) : line); });
  });
}

void Daemon::end_every_lease() {
  if (!motor_) return;
  if (const auto& holder = motor_->command().holder())
    motor_->client_gone(holder->client, "the remote link is dead");
}

void Daemon::on_remote_dead(std::int64_t now_ns, bool is_dead) {
  set_alarm(kRemotePort, Alarm::link_dead, is_dead, now_ns);
}

// The battery, and the alarms that follow from estimates.
namespace {

Alarm alarm_of(pipeline::EstimateAlarm alarm) {
  return alarm == pipeline::EstimateAlarm::battery_low ? Alarm::battery_low : Alarm::floor_near;
}

}  // namespace

void Daemon::on_battery(const pipeline::BatterySample& sample) {
  publisher_.battery(sample);
  log_.battery(sample);
  battery_.take(sample);
}

void Daemon::on_alarm(const pipeline::AlarmChange& change) {
  set_alarm(change.port, alarm_of(change.alarm), change.raised, change.time_ns, change.words);
}

std::string Daemon::answer_battery(const ControlRequest& request) {
  std::string problem;
  const auto charge = battery_.charge_of(request, problem);
  if (!charge) return control_error(problem);
  set_battery(*charge, "by command");
  return "{\"ok\":true}\n";
}

void Daemon::set_battery(const pipeline::BatteryCharge& charge, std::string_view cause) {
  const std::int64_t now_ns = ports::monotonic_ns();
  pipeline_.advance(now_ns, *this);  // what is due by then comes before it, live as in replay
  pipeline_.set_battery(charge);
  // The numbers in full, so that replay sets the same charge (record/json/message_json.h).
  event(now_ns, "info", "battery.set", "", record::battery_event_words(charge, cause));
}

}  // namespace navcal::daemon

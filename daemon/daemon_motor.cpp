// SPDX-License-Identifier: Apache-2.0
// Orders to the motor card, and the state that controllers answer with them.
#include <algorithm>

#include "daemon/daemon.h"

namespace navcal::daemon {

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
  const bool stands =
      std::any_of(standing.begin(), standing.end(), [&](const auto& alarm) { return is_leak(alarm.alarm); });
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

}  // namespace navcal::daemon

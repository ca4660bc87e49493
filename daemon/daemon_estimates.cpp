// SPDX-License-Identifier: Apache-2.0
// The battery, and the alarms that follow from estimates.

#include "daemon/daemon.h"
#include "record/json/message_json.h"

namespace navcal::daemon {
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

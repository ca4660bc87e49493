// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/daemon_metrics.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

using nlohmann::json;

using Names = std::span<const char* const>;

using Objects = std::vector<const json*>;

/// The same of several objects, which the text at `label` tells apart.
void append_members(Exposition& out, const Objects& objects, const char* label, const Members& members) {
  for (const Member& member : members) {
    out.metric(member.name, member.help);
    for (const json* one : objects) out.sample({{label, text_in(*one, label)}}, member.of(*one));
  }
}

constexpr const char* kLogStates[]{"writing", "full", "failing", "stopped", "off"};

constexpr const char* kOperatorStates[]{"none", "alive", "dead"};

constexpr const char* kClockSources[]{"none", "file", "system", "system-synchronised", "gps"};

constexpr const char* kVerdicts[]{"refused", "shadow", "in_force"};

/// 1 for the value that `state` has of `known`, 0 for the others; no line while it is not told.
void append_state(Exposition& out, const char* name, const char* help, const char* label, const std::string& state,
                  Names known) {
  out.metric(name, help);
  if (state.empty()) return;
  for (const char* one : known) out.sample({{label, one}}, state == one ? 1.0 : 0.0);
}

/// The same of several objects, which the text at `label` tells apart; `key` has the state.
void append_states(Exposition& out, const char* name, const char* help, const Objects& objects, const char* label,
                   const char* key, Names known) {
  out.metric(name, help);
  for (const json* object : objects) {
    const std::string state = text_in(*object, key), of = text_in(*object, label);
    if (state.empty()) continue;
    for (const char* one : known) out.sample({{label, of}, {key, one}}, state == one ? 1.0 : 0.0);
  }
}

void append_alarms(Exposition& out, const json& health) {
  const json& alarms = member_of(health, "alarms");
  if (!alarms.is_array()) return;
  out.single("navcald_alarms", "Alarms that stand.", alarms.size());
  out.metric("navcald_alarm", "1 for each alarm that stands; no line for others.");
  for (const json& alarm : alarms) {
    if (alarm.is_object())
      out.sample({{"alarm", text_in(alarm, "alarm")}, {"device", text_in(alarm, "device")}}, 1.0);
  }
}

constexpr const char* kPortStates[]{"running", "silent", "no_frames", "noisy", "away", "off"};

/// Bounds of the histogram in seconds: 1, 2, 4, ... microseconds. The daemon's last bucket has none.
constexpr std::size_t kLatencyBounds = 20;

std::array<double, kLatencyBounds> latency_bounds_s() {
  std::array<double, kLatencyBounds> bounds{};
  for (int i = 0; double& bound : bounds) bound = std::ldexp(1.0, i++) / 1e6;
  return bounds;
}

void append_port_latencies(Exposition& out, const Objects& ports) {
  static const auto kBounds_s = latency_bounds_s();
  out.metric("navcald_port_latency_seconds", "Time from the arrival of a sample's bytes to the status socket.");
  for (const json* port : ports) {
    const json& list = member_of(*port, "latency_log2_us");
    if (!list.is_array()) continue;
    std::vector<std::uint64_t> counts;
    for (const json& count : list) counts.push_back(count.is_number_unsigned() ? count.get<std::uint64_t>() : 0);
    out.histogram({{"device", text_in(*port, "device")}}, kBounds_s, counts, number_in(*port, "latency_sum_s"));
  }
}

/// The ports of all lines of one HEALTH: state, counters, clock and latency.
void append_ports(Exposition& out, const std::vector<json>& health_parts) {
  Objects ports;
  for (const json& part : health_parts) {
    for (const json& port : member_of(part, "ports")) {
      if (port.is_object() && !text_in(port, "device").empty()) ports.push_back(&port);
    }
  }
  append_states(out, "navcald_port_state", "1 for the state in which the port is, 0 for others.", ports, "device",
                "state", kPortStates);
  append_members(out, ports, "device", members_of("port"));
  append_port_latencies(out, ports);
}

}  // namespace

void append_members(Exposition& out, const json& object, const Members& members) {
  for (const Member& member : members) out.single(member.name, member.help, member.of(object));
}

void append_health(Exposition& out, const std::vector<json>& parts) {
  if (parts.empty()) return;
  const json& health = parts.front();
  append_members(out, health, members_of("health"));
  const json& process = member_of(health, "process");
  out.metric("navcald_info", "Version of navcald.");
  if (const std::string version = text_in(process, "version"); !version.empty())
    out.sample({{"version", version}}, 1.0);
  out.metric("navcald_vehicle_info", "Id and name of the vehicle, and the sum of its configuration.");
  const json& vehicle = member_of(health, "vehicle");
  if (vehicle.is_object()) {
    out.sample({{"id", text_in(vehicle, "id")},
                {"name", text_in(vehicle, "name")},
                {"config_crc32c", text_in(vehicle, "config_crc32c")}},
               1.0);
  }
  append_alarms(out, health);
  append_ports(out, parts);
  const json& log = member_of(health, "log");
  append_state(out, "navcald_log_state", "1 for the state in which the log is, 0 for others.", "state",
               text_in(log, "state"), kLogStates);
  const json& motor = member_of(health, "motor");
  if (motor.is_object())
    out.single("navcald_motor_held", "1 while somebody holds the motor.", !text_in(motor, "holder").empty());
  const json& remote = member_of(health, "remote");
  append_state(out, "navcald_remote_operator", "1 for the state of the operator, 0 for others.", "state",
               text_in(remote, "operator"), kOperatorStates);
}

void append_clock(Exposition& out, const json& time, const std::vector<json>& health_parts) {
  // HEALTH says it every second, and /time with all digits when it changes.
  const json& health = health_parts.empty() ? json() : member_of(health_parts.front(), "utc");
  const json& utc = time.is_object() ? time : health;
  append_state(out, "navcald_clock_source", "1 for where UTC comes from, 0 for others.", "source",
               text_in(utc, "source"), kClockSources);
  out.single("navcald_clock_bound_seconds", "UTC is known to within this.",
             number_in(utc, time.is_object() ? "bound" : "bound_s"));
}

void append_navigation(Exposition& out, const json& nav) {
  append_members(out, nav, members_of("navigation"));
  append_state(out, "navcald_position_state", "1 for how the position is known, 0 for others.", "state",
               text_in(nav, "position"), std::array{"none", "fixes", "reckoned"});
}

void append_batteries(Exposition& out, const std::vector<json>& batteries) {
  Objects each;
  for (const json& battery : batteries) each.push_back(&battery);
  append_members(out, each, "device", members_of("battery"));
}

void append_calibration(Exposition& out, const std::vector<json>& parts) {
  Objects calibrators;
  for (const json& part : parts) {
    for (const json& one : member_of(part, "calibrators")) {
      if (one.is_object()) calibrators.push_back(&one);
    }
  }
  append_states(out, "navcald_calibrator_verdict", "1 for the verdict on the newest estimate, 0 for others.",
                calibrators, "calibrator", "verdict", kVerdicts);
  append_members(out, calibrators, "calibrator", members_of("calibrator"));
}

}  // namespace navcal::web

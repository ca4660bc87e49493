// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/daemon_metrics.h"

#include <array>
#include <nlohmann/json.hpp>

#include "base/angles.h"
#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

using nlohmann::json;
using enum Exposition::Type;

/// A member of a message that is a metric by itself: a number, or 1 and 0 for true and false.
struct DaemonMember {
  const char* key;
  const char* name;
  Exposition::Type type;
  const char* help;
  double factor = 1;
  const char* within = nullptr;  ///< the object of the message in which it lies, if not the message itself

  [[nodiscard]] std::optional<double> of(const json& message) const {
    const json& object = within == nullptr ? message : member_of(message, within);
    const auto flag = flag_in(object, key);
    return flag ? flag : scaled(number_in(object, key), factor);
  }
};

template <std::size_t N>
void append_members(Exposition& out, const json& object, const std::array<DaemonMember, N>& members) {
  for (const DaemonMember& member : members) out.single(member.name, member.type, member.help, member.of(object));
}

using Objects = std::vector<const json*>;

/// The same of several objects, which the text at `label` tells apart.
template <std::size_t N>
void append_members(Exposition& out, const Objects& objects, const char* label,
                    const std::array<DaemonMember, N>& members) {
  for (const DaemonMember& member : members) {
    out.metric(member.name, member.type, member.help);
    for (const json* one : objects) out.sample({{label, text_in(*one, label)}}, member.of(*one));
  }
}

constexpr std::array kHealthMembers{
    DaemonMember{"uptime_s", "navcald_uptime_seconds", gauge, "Time since navcald was started."},
    DaemonMember{"clients", "navcald_status_clients", gauge, "Clients of the status socket."},
    DaemonMember{"client_queue_bytes", "navcald_status_client_queue_bytes", gauge,
                 "Bytes that wait for clients of the status socket."},
    DaemonMember{"client_dropped", "navcald_status_client_dropped_reports_total", counter,
                 "Reports that slow clients of the status socket missed."}};

constexpr std::array kLogMembers{
    DaemonMember{"bytes", "navcald_log_file_bytes", gauge, "Size of the log file that is being written."},
    DaemonMember{"synced", "navcald_log_synced_bytes", gauge, "Bytes of it that are safe from a loss of power."},
    DaemonMember{"queued", "navcald_log_queued_bytes", gauge, "Bytes that wait for the disk."},
    DaemonMember{"lost", "navcald_log_lost_records_total", counter, "Records that were lost for want of room."}};
constexpr std::array kLogStates{"writing", "full", "failing", "stopped", "off"};

constexpr std::array kMotorMembers{
    DaemonMember{"orders", "navcald_motor_orders_total", counter, "Orders to the motor card that were taken."},
    DaemonMember{"refused", "navcald_motor_refused_orders_total", counter, "Orders that were refused."},
    DaemonMember{"sent", "navcald_motor_sent_lines_total", counter, "Lines sent to the motor card."},
    DaemonMember{"echoed", "navcald_motor_echoed_lines_total", counter, "Lines that a status showed."},
    DaemonMember{"not_echoed", "navcald_motor_not_echoed_lines_total", counter, "Lines that no status showed."},
    DaemonMember{"superseded", "navcald_motor_superseded_lines_total", counter,
                 "Lines of which a later one was shown first."},
    DaemonMember{"echo_s", "navcald_motor_echo_seconds", gauge,
                 "Time from the last line to the status that showed it."}};

constexpr std::array kRemoteMembers{
    DaemonMember{"sessions", "navcald_remote_sessions_total", counter, "Sessions of the remote link."},
    DaemonMember{"frames", "navcald_remote_frames_total", counter, "Frames of the remote link."},
    DaemonMember{"bad_checksum", "navcald_remote_bad_checksums_total", counter, "Frames with a wrong checksum."},
    DaemonMember{"refused", "navcald_remote_refused_frames_total", counter, "Frames that were refused."},
    DaemonMember{"repeated", "navcald_remote_repeated_frames_total", counter, "Frames that came twice."},
    DaemonMember{"sent_bytes", "navcald_remote_sent_bytes_total", counter, "Bytes sent over the remote link."},
    DaemonMember{"loss", "navcald_remote_loss_ratio", gauge,
                 "Share of the operator's last frames that was lost."}};
constexpr std::array kOperatorStates{"none", "alive", "dead"};

constexpr double kBytesPerKB = 1024;  // of getrusage(2)
constexpr std::array kProcessMembers{
    DaemonMember{"cpu_s", "navcald_cpu_seconds_total", counter, "CPU time of navcald."},
    DaemonMember{"most_resident_kB", "navcald_most_resident_memory_bytes", gauge, "Largest memory of navcald.",
                 kBytesPerKB}};

constexpr std::array kClockSources{"none", "file", "system", "system-synchronised", "gps"};

constexpr std::array kNavigationMembers{
    DaemonMember{"time", "navcald_navigation_timestamp_seconds", gauge,
                 "UTC at which the estimate holds; absent while it is unknown."},
    DaemonMember{"time_std", "navcald_navigation_timestamp_std_seconds", gauge,
                 "Standard error of navcald_navigation_timestamp_seconds."},
    DaemonMember{"depth_m", "navcald_depth_meters", gauge, "Depth below the surface."},
    DaemonMember{"heading_rad", "navcald_heading_radians", gauge, "Heading."},
    DaemonMember{"heading_std_rad", "navcald_heading_std_radians", gauge, "Standard error of the heading."},
    DaemonMember{"pitch_rad", "navcald_pitch_radians", gauge, "Pitch, bow up."},
    DaemonMember{"roll_rad", "navcald_roll_radians", gauge, "Roll, starboard down."},
    DaemonMember{"speed_m_s", "navcald_speed_meters_per_second", gauge, "Speed ahead through the water."},
    DaemonMember{"north_std_m", "navcald_position_north_std_meters", gauge,
                 "Standard error of the position, north."},
    DaemonMember{"east_std_m", "navcald_position_east_std_meters", gauge, "Standard error of the position, east."},
    DaemonMember{"since_fix_s", "navcald_since_fix_seconds", gauge, "Time since the last fix."},
    DaemonMember{"since_fix_m", "navcald_since_fix_meters", gauge, "Way since the last fix."},
    DaemonMember{"altitude_m", "navcald_altitude_meters", gauge, "Height above the sea floor."},
    DaemonMember{"altitude_std_m", "navcald_altitude_std_meters", gauge, "Standard error of the height."},
    DaemonMember{"water_depth_m", "navcald_water_depth_meters", gauge, "Depth of the water."},
    DaemonMember{"predicted_error_m", "navcald_predicted_error_meters", gauge,
                 "95 % radius of the position at the first fix if the vehicle surfaced now."},
    DaemonMember{"surface_within_s", "navcald_surface_within_seconds", gauge,
                 "Time left to surface within navigation.max_error_m."}};

constexpr double kCoulombsPerAh = 3600, kJoulesPerWh = 3600, kRatioPerPercent = 0.01;
constexpr std::array kBatteryMembers{
    DaemonMember{"voltage_V", "navcald_battery_volts", gauge, "Voltage of the battery."},
    DaemonMember{"current_A", "navcald_battery_amperes", gauge, "Current out of the battery."},
    DaemonMember{"charge_Ah", "navcald_battery_charge_coulombs", gauge, "Charge that is left.", kCoulombsPerAh},
    DaemonMember{"charge_std_Ah", "navcald_battery_charge_std_coulombs", gauge,
                 "Standard error of navcald_battery_charge_coulombs.", kCoulombsPerAh},
    DaemonMember{"charge_percent", "navcald_battery_charge_ratio", gauge, "Charge that is left, of the capacity.",
                 kRatioPerPercent},
    DaemonMember{"energy_Wh", "navcald_battery_energy_joules", gauge, "Energy that is left.", kJoulesPerWh},
    DaemonMember{"time_left_s", "navcald_battery_time_left_seconds", gauge, "Time left at the mean load."},
    DaemonMember{"range_left_m", "navcald_battery_range_left_meters", gauge, "Way left at the mean speed."},
    DaemonMember{"low", "navcald_battery_low", gauge, "1 while the alarm of the battery stands."}};

constexpr std::array kCalibratorMembers{
    DaemonMember{"coverage", "navcald_calibrator_coverage_ratio", gauge, "Share of the headings that was seen."},
    DaemonMember{"samples", "navcald_calibrator_samples", gauge, "Readings behind the estimate."},
    DaemonMember{"held_out_before_deg", "navcald_calibrator_held_out_before_radians", gauge,
                 "Root-mean-square error of the heading on held-out readings, without the estimate.",
                 base::kRadiansPerDegree},
    DaemonMember{"held_out_after_deg", "navcald_calibrator_held_out_after_radians", gauge,
                 "Root-mean-square error of the heading on held-out readings, with the estimate.",
                 base::kRadiansPerDegree}};
constexpr std::array kVerdicts{"refused", "shadow", "in_force"};

/// 1 for the value that `state` has of `known`, 0 for the others; no line while it is not told.
template <std::size_t N>
void append_state(Exposition& out, const char* name, const char* help, const char* label, const std::string& state,
                  const std::array<const char*, N>& known) {
  out.metric(name, gauge, help);
  if (state.empty()) return;
  for (const char* one : known) out.sample({{label, one}}, state == one ? 1.0 : 0.0);
}

/// The same of several objects, which the text at `label` tells apart; `key` has the state.
template <std::size_t N>
void append_states(Exposition& out, const char* name, const char* help, const Objects& objects, const char* label,
                   const char* key, const std::array<const char*, N>& known) {
  out.metric(name, gauge, help);
  for (const json* object : objects) {
    const std::string state = text_in(*object, key), of = text_in(*object, label);
    if (state.empty()) continue;
    for (const char* one : known) out.sample({{label, of}, {key, one}}, state == one ? 1.0 : 0.0);
  }
}

void append_alarms(Exposition& out, const json& health) {
  const json& alarms = member_of(health, "alarms");
  if (!alarms.is_array()) return;
  out.single("navcald_alarms", gauge, "Alarms that stand.", static_cast<double>(alarms.size()));
  out.metric("navcald_alarm", gauge, "1 for each alarm that stands; no line for others.");
  for (const json& alarm : alarms) {
    if (alarm.is_object())
      out.sample({{"alarm", text_in(alarm, "alarm")}, {"device", text_in(alarm, "device")}}, 1.0);
  }
}

constexpr std::array kPortStates{"running", "silent", "no_frames", "noisy", "away", "off"};

constexpr std::array kPortCounters{
    DaemonMember{"opened", "navcald_port_opened_total", counter, "Times that the port was opened."},
    DaemonMember{"bytes", "navcald_port_bytes_total", counter, "Bytes received."},
    DaemonMember{"skipped", "navcald_port_skipped_bytes_total", counter,
                 "Bytes received that belong to no frame."},
    DaemonMember{"frames", "navcald_port_frames_total", counter, "Intact frames."},
    DaemonMember{"samples", "navcald_port_samples_total", counter, "Samples made of the frames."},
    DaemonMember{"bad", "navcald_port_bad_checksums_total", counter, "Frames with a wrong checksum."},
    DaemonMember{"unused", "navcald_port_unused_frames_total", counter, "Intact frames that gave no sample."},
    DaemonMember{"out_of_range", "navcald_port_out_of_range_frames_total", counter,
                 "Intact frames with impossible content."},
    DaemonMember{"gaps", "navcald_port_gaps_total", counter,
                 "Incomplete frames that were given up after a silence."},
    DaemonMember{"lost", "navcald_port_lost_frames_total", counter, "Frames missing by sequence number or clock."},
    DaemonMember{"repeated", "navcald_port_repeated_frames_total", counter, "Frames that came twice."}};

constexpr double kPpm = 1e-6;
constexpr std::array kPortClock{DaemonMember{"locked", "navcald_port_clock_locked", gauge,
                                             "1 when the clock of the device is known.", 1, "clock"},
                                DaemonMember{"period_s", "navcald_port_period_seconds", gauge,
                                             "Period of the frames, as it was learnt.", 1, "clock"},
                                DaemonMember{"jitter_s", "navcald_port_jitter_seconds", gauge,
                                             "Scatter of the arrivals about the clock of the device.", 1, "clock"},
                                DaemonMember{"skew_ppm", "navcald_port_clock_skew_ratio", gauge,
                                             "Rate of the clock of the device, less one.", kPpm, "clock"},
                                DaemonMember{"skew_std_ppm", "navcald_port_clock_skew_std_ratio", gauge,
                                             "Standard error of navcald_port_clock_skew_ratio.", kPpm, "clock"},
                                DaemonMember{"resets", "navcald_port_clock_resets_total", counter,
                                             "Times that the clock of the device was learnt anew.", 1, "clock"}};

/// Bounds of the histogram in seconds: 1, 2, 4, ... microseconds. The daemon's last bucket has none.
constexpr std::size_t kLatencyBounds = 20;

std::array<double, kLatencyBounds> latency_bounds_s() {
  std::array<double, kLatencyBounds> bounds{};
  double bound_us = 1;
  for (double& bound : bounds) {
    bound = bound_us / 1e6;
    bound_us *= 2;
  }
  return bounds;
}

void append_port_latencies(Exposition& out, const Objects& ports) {
  static const auto kBounds_s = latency_bounds_s();
  out.metric("navcald_port_latency_seconds", histogram,
             "Time from the arrival of a sample's bytes to the status socket.");
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
  append_members(out, ports, "device", kPortCounters);
  append_members(out, ports, "device", kPortClock);
  append_port_latencies(out, ports);
}

}  // namespace

void append_health(Exposition& out, const std::vector<json>& parts) {
  if (parts.empty()) return;
  const json& health = parts.front();
  append_members(out, health, kHealthMembers);
  const json& process = member_of(health, "process");
  append_members(out, process, kProcessMembers);
  out.metric("navcald_info", gauge, "Version of navcald.");
  if (const std::string version = text_in(process, "version"); !version.empty())
    out.sample({{"version", version}}, 1.0);
  out.metric("navcald_vehicle_info", gauge, "Id and name of the vehicle, and the sum of its configuration.");
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
  append_members(out, log, kLogMembers);
  const json& motor = member_of(health, "motor");
  append_members(out, motor, kMotorMembers);
  if (motor.is_object())
    out.single("navcald_motor_held", gauge, "1 while somebody holds the motor.",
               text_in(motor, "holder").empty() ? 0.0 : 1.0);
  const json& remote = member_of(health, "remote");
  append_members(out, remote, kRemoteMembers);
  append_state(out, "navcald_remote_operator", "1 for the state of the operator, 0 for others.", "state",
               text_in(remote, "operator"), kOperatorStates);
}

void append_clock(Exposition& out, const json& time, const std::vector<json>& health_parts) {
  // HEALTH says it every second, and /time with all digits when it changes.
  const json& health = health_parts.empty() ? json() : member_of(health_parts.front(), "utc");
  const json& utc = time.is_object() ? time : health;
  append_state(out, "navcald_clock_source", "1 for where UTC comes from, 0 for others.", "source",
               text_in(utc, "source"), kClockSources);
  out.single("navcald_clock_bound_seconds", gauge, "UTC is known to within this.",
             number_in(utc, time.is_object() ? "bound" : "bound_s"));
}

void append_navigation(Exposition& out, const json& nav) {
  append_members(out, nav, kNavigationMembers);
  append_state(out, "navcald_position_state", "1 for how the position is known, 0 for others.", "state",
               text_in(nav, "position"), std::array{"none", "fixes", "reckoned"});
  out.single("navcald_bottom_lock", gauge, "1 while a Doppler log measures over the bottom.",
             flag_in(nav, "bottom_lock"));
}

void append_batteries(Exposition& out, const std::vector<json>& batteries) {
  Objects each;
  for (const json& battery : batteries) each.push_back(&battery);
  append_members(out, each, "device", kBatteryMembers);
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
  append_members(out, calibrators, "calibrator", kCalibratorMembers);
}

}  // namespace navcal::web

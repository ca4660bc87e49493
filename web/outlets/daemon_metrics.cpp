// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/daemon_metrics.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "base/angles.h"
#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

using nlohmann::json;

/// A member of a message that is a metric by itself: a number, or 1 and 0 for true and false.
struct DaemonMember {
  std::string_view key;  ///< "object/key" for one that lies in an object of the message
  const char* name;
  const char* help;
  double factor = 1;

  [[nodiscard]] std::optional<double> of(const json& message) const {
    const std::size_t begin = key.find('/') + 1;  // 0 without one
    const json& object = begin == 0 ? message : member_of(message, std::string(key.substr(0, begin - 1)).c_str());
    const char* const name_in_it = key.data() + begin;
    const auto flag = flag_in(object, name_in_it);
    return flag ? flag : scaled(number_in(object, name_in_it), factor);
  }
};

using Members = std::span<const DaemonMember>;
using Names = std::span<const char* const>;

void append_members(Exposition& out, const json& object, Members members) {
  for (const DaemonMember& member : members) out.single(member.name, member.help, member.of(object));
}

using Objects = std::vector<const json*>;

/// The same of several objects, which the text at `label` tells apart.
void append_members(Exposition& out, const Objects& objects, const char* label, Members members) {
  for (const DaemonMember& member : members) {
    out.metric(member.name, member.help);
    for (const json* one : objects) out.sample({{label, text_in(*one, label)}}, member.of(*one));
  }
}

constexpr double kBytesPerKB = 1024;  // of getrusage(2)
constexpr DaemonMember kHealthMembers[]{
    {"uptime_s", "navcald_uptime_seconds", "Time since navcald was started."},
    {"clients", "navcald_status_clients", "Clients of the status socket."},
    {"client_queue_bytes", "navcald_status_client_queue_bytes",
     "Bytes that wait for clients of the status socket."},
    {"client_dropped", "navcald_status_client_dropped_reports_total",
     "Reports that slow clients of the status socket missed."},
    {"process/cpu_s", "navcald_cpu_seconds_total", "CPU time of navcald."},
    {"process/most_resident_kB", "navcald_most_resident_memory_bytes", "Largest memory of navcald.", kBytesPerKB},
    {"log/bytes", "navcald_log_file_bytes", "Size of the log file that is being written."},
    {"log/synced", "navcald_log_synced_bytes", "Bytes of it that are safe from a loss of power."},
    {"log/queued", "navcald_log_queued_bytes", "Bytes that wait for the disk."},
    {"log/lost", "navcald_log_lost_records_total", "Records that were lost for want of room."},
    {"motor/orders", "navcald_motor_orders_total", "Orders to the motor card that were taken."},
    {"motor/refused", "navcald_motor_refused_orders_total", "Orders that were refused."},
    {"motor/sent", "navcald_motor_sent_lines_total", "Lines sent to the motor card."},
    {"motor/echoed", "navcald_motor_echoed_lines_total", "Lines that a status showed."},
    {"motor/not_echoed", "navcald_motor_not_echoed_lines_total", "Lines that no status showed."},
    {"motor/superseded", "navcald_motor_superseded_lines_total", "Lines of which a later one was shown first."},
    {"motor/echo_s", "navcald_motor_echo_seconds", "Time from the last line to the status that showed it."},
    {"remote/sessions", "navcald_remote_sessions_total", "Sessions of the remote link."},
    {"remote/frames", "navcald_remote_frames_total", "Frames of the remote link."},
    {"remote/bad_checksum", "navcald_remote_bad_checksums_total", "Frames with a wrong checksum."},
    {"remote/refused", "navcald_remote_refused_frames_total", "Frames that were refused."},
    {"remote/repeated", "navcald_remote_repeated_frames_total", "Frames that came twice."},
    {"remote/sent_bytes", "navcald_remote_sent_bytes_total", "Bytes sent over the remote link."},
    {"remote/loss", "navcald_remote_loss_ratio", "Share of the operator's last frames that was lost."}};

constexpr const char* kLogStates[]{"writing", "full", "failing", "stopped", "off"};

constexpr const char* kOperatorStates[]{"none", "alive", "dead"};

constexpr const char* kClockSources[]{"none", "file", "system", "system-synchronised", "gps"};

constexpr DaemonMember kNavigationMembers[]{
    {"time", "navcald_navigation_timestamp_seconds",
     "UTC at which the estimate holds; absent while it is unknown."},
    {"time_std", "navcald_navigation_timestamp_std_seconds",
     "Standard error of navcald_navigation_timestamp_seconds."},
    {"depth_m", "navcald_depth_meters", "Depth below the surface."},
    {"heading_rad", "navcald_heading_radians", "Heading."},
    {"heading_std_rad", "navcald_heading_std_radians", "Standard error of the heading."},
    {"pitch_rad", "navcald_pitch_radians", "Pitch, bow up."},
    {"roll_rad", "navcald_roll_radians", "Roll, starboard down."},
    {"speed_m_s", "navcald_speed_meters_per_second", "Speed ahead through the water."},
    {"north_std_m", "navcald_position_north_std_meters", "Standard error of the position, north."},
    {"east_std_m", "navcald_position_east_std_meters", "Standard error of the position, east."},
    {"since_fix_s", "navcald_since_fix_seconds", "Time since the last fix."},
    {"since_fix_m", "navcald_since_fix_meters", "Way since the last fix."},
    {"altitude_m", "navcald_altitude_meters", "Height above the sea floor."},
    {"altitude_std_m", "navcald_altitude_std_meters", "Standard error of the height."},
    {"water_depth_m", "navcald_water_depth_meters", "Depth of the water."},
    {"predicted_error_m", "navcald_predicted_error_meters",
     "95 % radius of the position at the first fix if the vehicle surfaced now."},
    {"surface_within_s", "navcald_surface_within_seconds", "Time left to surface within navigation.max_error_m."},
    {"bottom_lock", "navcald_bottom_lock", "1 while a Doppler log measures over the bottom."}};

constexpr double kCoulombsPerAh = 3600, kJoulesPerWh = 3600, kRatioPerPercent = 0.01;
constexpr DaemonMember kBatteryMembers[]{
    {"voltage_V", "navcald_battery_volts", "Voltage of the battery."},
    {"current_A", "navcald_battery_amperes", "Current out of the battery."},
    {"charge_Ah", "navcald_battery_charge_coulombs", "Charge that is left.", kCoulombsPerAh},
    {"charge_std_Ah", "navcald_battery_charge_std_coulombs", "Standard error of navcald_battery_charge_coulombs.",
     kCoulombsPerAh},
    {"charge_percent", "navcald_battery_charge_ratio", "Charge that is left, of the capacity.", kRatioPerPercent},
    {"energy_Wh", "navcald_battery_energy_joules", "Energy that is left.", kJoulesPerWh},
    {"time_left_s", "navcald_battery_time_left_seconds", "Time left at the mean load."},
    {"range_left_m", "navcald_battery_range_left_meters", "Way left at the mean speed."},
    {"low", "navcald_battery_low", "1 while the alarm of the battery stands."}};

constexpr DaemonMember kCalibratorMembers[]{
    {"coverage", "navcald_calibrator_coverage_ratio", "Share of the headings that was seen."},
    {"samples", "navcald_calibrator_samples", "Readings behind the estimate."},
    {"held_out_before_deg", "navcald_calibrator_held_out_before_radians",
     "Root-mean-square error of the heading on held-out readings, without the estimate.", base::kRadiansPerDegree},
    {"held_out_after_deg", "navcald_calibrator_held_out_after_radians",
     "Root-mean-square error of the heading on held-out readings, with the estimate.", base::kRadiansPerDegree}};
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

constexpr double kPpm = 1e-6;
constexpr DaemonMember kPortMembers[]{
    {"opened", "navcald_port_opened_total", "Times that the port was opened."},
    {"bytes", "navcald_port_bytes_total", "Bytes received."},
    {"skipped", "navcald_port_skipped_bytes_total", "Bytes received that belong to no frame."},
    {"frames", "navcald_port_frames_total", "Intact frames."},
    {"samples", "navcald_port_samples_total", "Samples made of the frames."},
    {"bad", "navcald_port_bad_checksums_total", "Frames with a wrong checksum."},
    {"unused", "navcald_port_unused_frames_total", "Intact frames that gave no sample."},
    {"out_of_range", "navcald_port_out_of_range_frames_total", "Intact frames with impossible content."},
    {"gaps", "navcald_port_gaps_total", "Incomplete frames that were given up after a silence."},
    {"lost", "navcald_port_lost_frames_total", "Frames missing by sequence number or clock."},
    {"repeated", "navcald_port_repeated_frames_total", "Frames that came twice."},
    {"clock/locked", "navcald_port_clock_locked", "1 when the clock of the device is known."},
    {"clock/period_s", "navcald_port_period_seconds", "Period of the frames, as it was learnt."},
    {"clock/jitter_s", "navcald_port_jitter_seconds", "Scatter of the arrivals about the clock of the device."},
    {"clock/skew_ppm", "navcald_port_clock_skew_ratio", "Rate of the clock of the device, less one.", kPpm},
    {"clock/skew_std_ppm", "navcald_port_clock_skew_std_ratio", "Standard error of navcald_port_clock_skew_ratio.",
     kPpm},
    {"clock/resets", "navcald_port_clock_resets_total", "Times that the clock of the device was learnt anew."}};

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
  append_members(out, ports, "device", kPortMembers);
  append_port_latencies(out, ports);
}

}  // namespace

void append_health(Exposition& out, const std::vector<json>& parts) {
  if (parts.empty()) return;
  const json& health = parts.front();
  append_members(out, health, kHealthMembers);
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
  append_members(out, nav, kNavigationMembers);
  append_state(out, "navcald_position_state", "1 for how the position is known, 0 for others.", "state",
               text_in(nav, "position"), std::array{"none", "fixes", "reckoned"});
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

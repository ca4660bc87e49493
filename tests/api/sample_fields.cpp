// SPDX-License-Identifier: Apache-2.0
#include "tests/api/sample_fields.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/angles.h"

namespace navcal::api::test {
namespace {

using Json = nlohmann::ordered_json;

/// As `navcal replay` writes a time, from integers.
std::string seconds_text(std::int64_t ns) {
  std::string digits = std::to_string(ns < 0 ? -ns : ns);
  if (digits.size() < 10) digits.insert(0, 10 - digits.size(), '0');
  return (ns < 0 ? "-" : "") + digits.substr(0, digits.size() - 9) + "." + digits.substr(digits.size() - 9);
}

std::string text_after(const std::string& line, const std::string& key) {
  const std::string quoted = "\"" + key + "\":";
  const auto at = line.find(quoted);
  if (at == std::string::npos) return {};
  const auto begin = at + quoted.size();
  return line.substr(begin, line.find_first_of(",}", begin) - begin);
}

std::optional<double> degrees(const std::optional<double>& rad) {
  if (!rad) return std::nullopt;
  return *rad * base::kDegreesPerRadian;
}

/// The members of a sample as JSON, with the keys of `navcal replay`.
struct Members {
  Json json = Json::object();

  void put(const char* key, const std::optional<double>& value) { json[key] = value ? Json(*value) : Json(); }
  void put(const char* key, const std::optional<Vector3>& value) { json[key] = value ? Json(*value) : Json(); }
  void put(const char* key, const std::optional<std::uint8_t>& value) {
    json[key] = value ? Json(*value) : Json();
  }
  void flag(const char* key, bool value) { json[key] = value; }
  void text(const char* key, std::string value) { json[key] = std::move(value); }

  void operator()(const CompassSample& s) {
    text("class", "COMPASS");
    put("heading_rad", s.heading_rad);
    put("heading_calibrated_rad", s.heading_calibrated_rad);
    flag("heading_is_true", s.heading_is_true);
    put("pitch_rad", s.pitch_rad);
    put("roll_rad", s.roll_rad);
    put("field_body_uT", s.field_body_uT);
    put("dip_rad", s.dip_rad);
    put("turn_rate_rad_s", s.turn_rate_rad_s);
    put("temperature_C", s.temperature_C);
    flag("tilt_by_accelerometers", s.tilt_by_accelerometers);
    put("heading_std_rad", s.heading_std_rad);
    put("tilt_std_rad", s.tilt_std_rad);
    put("field_std_uT", s.field_std_uT);
  }
  void operator()(const ImuSample& s) {
    text("class", "IMU");
    put("rate_rad_s", s.rate_rad_s);
    put("yaw_rate_b_rad_s", s.yaw_rate_b_rad_s);
    put("yaw_rate_calibrated_rad_s", s.yaw_rate_calibrated_rad_s);
    put("yaw_rate_b_calibrated_rad_s", s.yaw_rate_b_calibrated_rad_s);
    put("specific_force_m_s2", s.specific_force_m_s2);
    put("depth_m", s.depth_m);
    put("sequence", s.card ? std::optional(s.card->sequence) : std::nullopt);
    json["leak_forward"] = s.card ? Json(s.card->leak_forward) : Json();
    json["leak_aft"] = s.card ? Json(s.card->leak_aft) : Json();
    json["low_supply"] = s.card ? Json(s.card->low_supply) : Json();
    flag("over_range", s.over_range);
    put("temperature_C", s.temperature_C);
    put("rate_std_rad_s", s.rate_std_rad_s);
    put("specific_force_std_m_s2", s.specific_force_std_m_s2);
    put("depth_std_m", s.depth_std_m);
  }
  void operator()(const GpsSample& s) {
    constexpr std::array kFixes{"none", "2d", "3d", "propagated", "hold", "acquiring", "bad_geometry"};
    text("class", "GPS");
    put("lat", degrees(s.latitude_rad));
    put("lon", degrees(s.longitude_rad));
    put("speed_m_s", s.speed_m_s);
    put("course_rad", s.course_rad);
    text("fix", kFixes.at(static_cast<std::size_t>(s.fix)));
    put("height_m", s.height_m);
    put("height_msl_m", s.height_msl_m);
    put("climb_m_s", s.climb_m_s);
    put("dop", s.dop);
    put("visible", s.visible);
    put("tracked", s.tracked);
    flag("time_corrected", s.time_corrected);
    flag("leap_known", s.leap_known);
    put("position_std_m", s.position_std_m);
    put("height_std_m", s.height_std_m);
    put("velocity_std_m_s", s.velocity_std_m_s);
  }
  void operator()(const MotorSample& s) {
    text("class", "MOTOR");
    put("rpm", s.rpm);
    put("rpm_commanded", s.rpm_commanded);
    for (const auto& fin : s.fins_rad) json["fins_rad"].push_back(fin ? Json(*fin) : Json());
    put("current_A", s.current_A);
    put("sequence", s.sequence);
    put("fins_std_rad", s.fins_std_rad);
    put("current_std_A", s.current_std_A);
  }
  void operator()(const AltimeterSample& s) {
    text("class", "ALTIMETER");
    put("altitude_m", std::optional(s.altitude_m));
    put("altitude_std_m", s.altitude_std_m);
  }
  void operator()(const PowerSample& s) {
    text("class", "POWER");
    put("voltage_V", s.voltage_V);
    put("current_A", s.current_A);
  }
  void operator()(const DvlSample& s) {
    text("class", "DVL");
    text("frame", s.frame == VelocityFrame::body ? "body" : "earth");
    put("bottom_velocity_m_s", s.bottom_velocity_m_s);
    put("bottom_velocity_std_m_s", s.bottom_velocity_std_m_s);
    put("water_velocity_m_s", s.water_velocity_m_s);
    put("water_velocity_std_m_s", s.water_velocity_std_m_s);
    put("altitude_m", s.altitude_m);
    put("altitude_std_m", s.altitude_std_m);
    put("temperature_C", s.temperature_C);
    put("sound_speed_m_s", s.sound_speed_m_s);
  }
  void operator()(const DepthSample& s) {
    text("class", "DEPTH");
    put("depth_m", s.depth_m);
    put("depth_std_m", s.depth_std_m);
    put("pressure_Pa", s.pressure_Pa);
    put("pressure_std_Pa", s.pressure_std_Pa);
    put("temperature_C", s.temperature_C);
  }
  void operator()(const ScalarSample& s) {
    text("class", "SENSOR");
    text("quantity", s.quantity);
    text("unit", s.unit);
    put("value", std::optional(s.value));
    put("value_std", s.value_std);
  }
  void operator()(const NavigationSample& s) {
    text("class", "NAV");
    put("lat", degrees(s.latitude_rad));
    put("lon", degrees(s.longitude_rad));
    put("north_std_m", s.north_std_m);
    put("east_std_m", s.east_std_m);
    put("since_fix_s", s.since_fix_s);
    put("since_fix_m", s.since_fix_m);
    put("depth_m", s.depth_m);
    put("depth_std_m", s.depth_std_m);
    put("heading_rad", s.heading_rad);
    put("heading_std_rad", s.heading_std_rad);
    put("pitch_rad", s.pitch_rad);
    put("roll_rad", s.roll_rad);
    put("speed_m_s", s.speed_m_s);
    put("velocity_m_s", s.velocity_m_s);
    put("set_north_m_s", s.set_north_m_s);
    put("set_east_m_s", s.set_east_m_s);
    put("altitude_m", s.altitude_m);
    put("altitude_std_m", s.altitude_std_m);
    put("water_depth_m", s.water_depth_m);
  }
  void operator()(const BatterySample& s) {
    text("class", "BATTERY");
    put("voltage_V", s.voltage_V);
    put("current_A", s.current_A);
    flag("current_measured", s.current_measured);
    put("charge_Ah", s.charge_Ah);
    put("charge_std_Ah", s.charge_std_Ah);
    put("time_left_s", s.time_left_s);
    put("range_left_m", s.range_left_m);
    flag("low", s.low);
  }
};

/// Keys of a line that are compared apart from the members, or are not in a sample: head, error codes, and what
/// follows from the navigator's other reports.
bool is_compared_apart(const std::string& key) {
  static const std::set<std::string> kApart{
      "time",           "time_std", "arrival",      "device",           "calibration",
      "error",          "position", "speed_source", "bottom_lock",      "dvl_outliers",
      "outage_s",       "outage_m", "outage_std_m", "submerged_s",      "outage_error_uncalibrated_m",
      "deepest_m",      "ttff_s",   "fix_visible",  "fix_tracked",      "predicted_error_m",
      "outage_error_m", "fix_dop",  "energy_Wh",    "surface_within_s", "charge_percent"};
  return kApart.contains(key);
}

std::string head_difference(const Sample& sample, const std::vector<Port>& ports, const std::string& line) {
  const std::pair<const char*, std::int64_t> times[] = {{"time", sample.stamp.validity_utc_ns},
                                                        {"time_std", sample.stamp.std_ns},
                                                        {"arrival", sample.stamp.arrival_utc_ns}};
  for (const auto& [key, ns] : times) {
    if (text_after(line, key) != seconds_text(ns)) return std::string(key) + " " + seconds_text(ns);
  }
  const std::string device = sample.port == Sample::kNoPort ? "navigation" : ports.at(sample.port).name;
  if (text_after(line, "device") != "\"" + device + "\"") return "device " + device;
  return {};
}

}  // namespace

std::vector<std::string> sample_lines(const std::string& output) {
  static const std::set<std::string> kClasses{"COMPASS", "IMU",   "GPS",    "MOTOR", "ALTIMETER", "POWER",
                                              "DVL",     "DEPTH", "SENSOR", "NAV",   "BATTERY"};
  std::vector<std::string> lines;
  std::istringstream stream(output);
  for (std::string line; std::getline(stream, line);) {
    const std::string name = text_after(line, "class");
    if (name.size() > 2 && kClasses.contains(name.substr(1, name.size() - 2))) lines.push_back(line);
  }
  return lines;
}

std::string difference(const Sample& sample, const std::vector<Port>& ports, const std::string& line) {
  if (auto found = head_difference(sample, ports, line); !found.empty()) return found;
  Members members;
  std::visit(members, sample.value);
  const Json said = Json::parse(line);
  for (const auto& [key, value] : said.items()) {
    if (is_compared_apart(key)) continue;
    if (!members.json.contains(key)) return key + " is missing";
    // Numbers are written with as many digits as tell them apart, so equal means equal to the last bit.
    if (members.json[key] != value) return key + " " + members.json[key].dump();
  }
  for (const auto& [key, value] : members.json.items()) {
    if (!said.contains(key)) return key + " is not in the line";
  }
  return {};
}

std::string difference(const std::vector<Sample>& samples, const std::vector<Port>& ports,
                       const std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < samples.size() && i < lines.size(); ++i) {
    const auto found = difference(samples[i], ports, lines[i]);
    if (!found.empty()) return "sample " + std::to_string(i) + ": " + found + "; the program says " + lines[i];
  }
  if (samples.size() == lines.size()) return {};
  return std::to_string(samples.size()) + " samples, and the program has " + std::to_string(lines.size());
}

}  // namespace navcal::api::test

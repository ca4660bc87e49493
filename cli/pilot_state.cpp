// SPDX-License-Identifier: Apache-2.0
#include "cli/pilot_state.h"

#include <nlohmann/json.hpp>

#include "base/angles.h"

namespace navcal::cli {
namespace {

const nlohmann::json& member(const nlohmann::json& object, const char* key) {
  static const nlohmann::json kAbsent;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? *found : kAbsent;
}

std::optional<double> number_at(const nlohmann::json& object, const char* key) {
  const nlohmann::json& value = member(object, key);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::optional<double> angle(const nlohmann::json& object, const char* key) {
  const auto degrees = number_at(object, key);
  return degrees ? std::optional(*degrees * base::kRadiansPerDegree) : std::nullopt;
}

std::optional<Eigen::Vector3d> vector(const nlohmann::json& object, const char* key) {
  const nlohmann::json& value = member(object, key);
  if (!value.is_array() || value.size() != 3) return std::nullopt;
  Eigen::Vector3d all;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!value[i].is_number()) return std::nullopt;
    all[static_cast<Eigen::Index>(i)] = value[i].get<double>();
  }
  return all;
}

}  // namespace

std::optional<StateLine> parse_state(std::string_view line) {
  const nlohmann::json report = nlohmann::json::parse(line, nullptr, false);
  if (!report.is_object() || member(report, "class") != "STATE") return std::nullopt;
  const auto time_s = number_at(report, "time");
  if (!time_s) return std::nullopt;
  StateLine state;
  state.time_s = *time_s;
  state.magnetic = member(report, "north") == "magnetic";
  autopilot::Reading& reading = state.reading;
  reading.heading_rad = number_at(report, "heading_rad");
  reading.pitch_rad = number_at(report, "pitch_rad");
  reading.roll_rad = number_at(report, "roll_rad");
  reading.rate_rad_s = vector(report, "rate_rad_s");
  reading.depth_m = number_at(report, "depth_m");
  reading.altitude_m = number_at(report, "altitude_m");
  reading.latitude_rad = angle(report, "lat");
  reading.longitude_rad = angle(report, "lon");
  reading.speed_m_s = number_at(report, "speed_m_s");
  const nlohmann::json& age = member(report, "age_s");
  reading.compass_age_s = number_at(age, "compass");
  reading.imu_age_s = number_at(age, "imu");
  reading.motor_age_s = number_at(age, "motor");
  for (const nlohmann::json& alarm : member(report, "alarms")) {
    if (alarm.is_string()) reading.alarms.push_back(alarm.get<std::string>());
  }
  return state;
}

}  // namespace navcal::cli

// SPDX-License-Identifier: Apache-2.0
#include "record/json/sample_json.h"

#include <fmt/format.h>

#include "base/angles.h"
#include "record/json/json_object.h"
#include "record/json/sample_head.h"

namespace navcal::record {
namespace {

std::optional<double> degrees(const std::optional<double>& rad) {
  if (!rad) return std::nullopt;
  return *rad * base::kDegreesPerRadian;
}

void append_count(JsonObject& json, std::string_view key, const std::optional<std::uint8_t>& count) {
  if (count) {
    json.integer(key, *count);
  } else {
    json.null(key);
  }
}

void append_vector(JsonObject& json, std::string_view key, const std::optional<instruments::Vector3>& vector) {
  if (vector) {
    json.numbers(key, *vector);
  } else {
    json.null(key);
  }
}

/// Writes the members that each kind of sample has of its own.
struct Body {
  JsonObject& json;

  void operator()(const instruments::CompassSample& s) const {
    json.number("heading_rad", s.heading_rad);
    json.number("heading_calibrated_rad", s.heading_calibrated_rad);
    json.boolean("heading_is_true", s.heading_is_true);
    json.number("pitch_rad", s.pitch_rad);
    json.number("roll_rad", s.roll_rad);
    append_vector(json, "field_body_uT", s.field_body_uT);
    json.number("dip_rad", s.dip_rad);
    json.number("turn_rate_rad_s", s.turn_rate_rad_s);
    json.number("temperature_C", s.temperature_C);
    if (s.error) {
      json.text("error", fmt::format("{:03X}", *s.error));
    } else {
      json.null("error");
    }
    json.boolean("tilt_by_accelerometers", s.tilt_by_accelerometers);
    json.number("heading_std_rad", s.heading_std_rad);
    json.number("tilt_std_rad", s.tilt_std_rad);
    json.number("field_std_uT", s.field_std_uT);
  }

  void operator()(const instruments::ImuSample& s) const {
    append_vector(json, "rate_rad_s", s.rate_rad_s);
    json.number("yaw_rate_b_rad_s", s.yaw_rate_b_rad_s);
    json.number("yaw_rate_calibrated_rad_s", s.yaw_rate_calibrated_rad_s);
    json.number("yaw_rate_b_calibrated_rad_s", s.yaw_rate_b_calibrated_rad_s);
    append_vector(json, "specific_force_m_s2", s.specific_force_m_s2);
    json.number("depth_m", s.depth_m);
    if (const auto& card = s.card) {
      json.integer("sequence", card->sequence);
      json.boolean("leak_forward", card->leak_forward);
      json.boolean("leak_aft", card->leak_aft);
      json.boolean("low_supply", card->low_supply);
    } else {
      for (const char* key : {"sequence", "leak_forward", "leak_aft", "low_supply"}) json.null(key);
    }
    json.boolean("over_range", s.over_range);
    json.number("temperature_C", s.temperature_C);
    json.number("rate_std_rad_s", s.rate_std_rad_s);
    json.number("specific_force_std_m_s2", s.specific_force_std_m_s2);
    json.number("depth_std_m", s.depth_std_m);
  }

  void operator()(const instruments::GpsSample& s) const {
    json.number("lat", degrees(s.latitude_rad));
    json.number("lon", degrees(s.longitude_rad));
    json.number("speed_m_s", s.speed_m_s);
    json.number("course_rad", s.course_rad);
    json.text("fix", name_of(s.fix));
    json.number("height_m", s.height_m);
    json.number("height_msl_m", s.height_msl_m);
    json.number("climb_m_s", s.climb_m_s);
    json.number("dop", s.dop);
    append_count(json, "visible", s.visible);
    append_count(json, "tracked", s.tracked);
    json.boolean("time_corrected", s.time_corrected);
    json.boolean("leap_known", s.leap_known);
    json.number("position_std_m", s.position_std_m);
    json.number("height_std_m", s.height_std_m);
    json.number("velocity_std_m_s", s.velocity_std_m_s);
  }

  void operator()(const instruments::SkySample& s) const {
    std::int64_t used = 0;
    for (std::size_t i = 0; i < s.count; ++i) used += s.satellites[i].used ? 1 : 0;
    json.integer("visible", static_cast<std::int64_t>(s.count));
    json.integer("used", used);
  }

  void operator()(const instruments::MotorSample& s) const {
    json.number("rpm", s.rpm);
    json.number("rpm_commanded", s.rpm_commanded);
    json.numbers("fins_rad", s.fins_rad);
    json.number("current_A", s.current_A);
    append_count(json, "sequence", s.sequence);
    json.number("fins_std_rad", s.fins_std_rad);
    json.number("current_std_A", s.current_std_A);
  }

  void operator()(const instruments::AltimeterSample& s) const {
    json.number("altitude_m", s.altitude_m);
    json.number("altitude_std_m", s.altitude_std_m);
  }

  void operator()(const instruments::PowerSample& s) const {
    json.number("voltage_V", s.voltage_V);
    json.number("current_A", s.current_A);
  }

  void operator()(const instruments::DvlSample& s) const {
    json.text("frame", s.frame == instruments::VelocityFrame::body ? "body" : "earth");
    append_vector(json, "bottom_velocity_m_s", s.bottom_velocity_m_s);
    json.number("bottom_velocity_std_m_s", s.bottom_velocity_std_m_s);
    append_vector(json, "water_velocity_m_s", s.water_velocity_m_s);
    json.number("water_velocity_std_m_s", s.water_velocity_std_m_s);
    json.number("altitude_m", s.altitude_m);
    json.number("altitude_std_m", s.altitude_std_m);
    json.number("temperature_C", s.temperature_C);
    json.number("sound_speed_m_s", s.sound_speed_m_s);
  }

  void operator()(const instruments::DepthSample& s) const {
    json.number("depth_m", s.depth_m);
    json.number("depth_std_m", s.depth_std_m);
    json.number("pressure_Pa", s.pressure_Pa);
    json.number("pressure_std_Pa", s.pressure_std_Pa);
    json.number("temperature_C", s.temperature_C);
  }

  void operator()(const instruments::ScalarSample& s) const {
    json.text("quantity", s.quantity.view());
    json.text("unit", s.unit.view());
    json.number("value", s.value);
    json.number("value_std", s.value_std);
  }
};

struct ClassName {
  std::string_view operator()(const instruments::CompassSample&) const { return "COMPASS"; }
  std::string_view operator()(const instruments::ImuSample&) const { return "IMU"; }
  std::string_view operator()(const instruments::GpsSample&) const { return "GPS"; }
  std::string_view operator()(const instruments::SkySample&) const { return "SKY"; }
  std::string_view operator()(const instruments::MotorSample&) const { return "MOTOR"; }
  std::string_view operator()(const instruments::AltimeterSample&) const { return "ALTIMETER"; }
  std::string_view operator()(const instruments::PowerSample&) const { return "POWER"; }
  std::string_view operator()(const instruments::DvlSample&) const { return "DVL"; }
  std::string_view operator()(const instruments::DepthSample&) const { return "DEPTH"; }
  std::string_view operator()(const instruments::ScalarSample&) const { return "SENSOR"; }
};

}  // namespace

void append_head(JsonObject& json, const instruments::Stamp& stamp, std::string_view device) {
  json.seconds("time", stamp.validity_utc_ns);
  json.seconds("time_std", stamp.std_ns);
  json.seconds("arrival", stamp.arrival_utc_ns);
  json.text("device", device);
}

void append_calibration(JsonObject& json, instruments::CalibrationName name) {
  if (name.number == 0) {
    json.null("calibration");
  } else {
    json.text("calibration", calibration_text(name));
  }
}

std::string calibration_text(instruments::CalibrationName name) {
  return fmt::format("{}-{:08x}", name.number, name.sum);
}

void append_json(std::string& out, const instruments::Sample& sample, std::string_view device) {
  JsonObject json(out, std::visit(ClassName{}, sample.value));
  append_head(json, sample.stamp, device);
  std::visit(Body{json}, sample.value);
  append_calibration(json, sample.calibration);
}

}  // namespace navcal::record

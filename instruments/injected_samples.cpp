// SPDX-License-Identifier: Apache-2.0
#include "instruments/injected_samples.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>
#include <string>

#include "base/angles.h"
#include "protocols/samples_line.h"

namespace navcal::instruments {
namespace {

using protocols::samples_line::Bounds;
using protocols::samples_line::Fields;
using protocols::samples_line::Object;

// Beyond these a value cannot be one of a vehicle on this planet.
constexpr double kPi = std::numbers::pi;
constexpr Bounds kHeading_rad{-2 * kPi, 2 * kPi}, kTilt_rad{-kPi, kPi}, kDip_rad{-kPi / 2, kPi / 2};
constexpr Bounds kFin_rad{-kPi, kPi}, kRate_rad_s{-100, 100}, kForce_m_s2{-2000, 2000}, kField_uT{-10'000, 10'000};
constexpr Bounds kTemperature_C{-273.15, 1000}, kDepth_m{-100, 12'000}, kHeight_m{-12'000, 100'000};
constexpr Bounds kPressure_Pa{0, 2e8}, kSpeed_m_s{-1000, 1000}, kGroundSpeed_m_s{0, 1000}, kAltitude_m{0, 12'000};
constexpr Bounds kLatitude_deg{-90, 90}, kLongitude_deg{-180, 180}, kDop{0, 1e6}, kSound_m_s{300, 3000};
constexpr Bounds kTurns_min{-100'000, 100'000}, kVoltage_V{0, 1000}, kCurrent_A{-1000, 1000};
constexpr Bounds kError{0, 1e6}, kAny{-1e300, 1e300};

std::optional<double> heading(Fields& fields, std::string_view key) {
  const auto angle_rad = fields.number(key, kHeading_rad);
  return angle_rad ? std::optional(base::as_heading(*angle_rad)) : std::nullopt;
}

std::optional<double> radians(const std::optional<double>& angle_deg) {
  return angle_deg ? std::optional(*angle_deg * base::kRadiansPerDegree) : std::nullopt;
}

std::optional<std::uint8_t> count(Fields& fields, std::string_view key) {
  const auto value = fields.integer(key, 255);
  return value ? std::optional(static_cast<std::uint8_t>(*value)) : std::nullopt;
}

/// A sample, or nullopt where the line has none of its members.
using Found = std::optional<Value>;

Found read_compass(Fields& fields) {
  CompassSample sample;
  sample.heading_rad = heading(fields, "heading_rad");
  sample.heading_is_true = fields.boolean("heading_is_true").value_or(false);
  sample.pitch_rad = fields.number("pitch_rad", kTilt_rad);
  sample.roll_rad = fields.number("roll_rad", kTilt_rad);
  sample.tilt_by_accelerometers = fields.boolean("tilt_by_accelerometers").value_or(false);
  sample.field_body_uT = fields.vector("field_body_uT", kField_uT);
  sample.dip_rad = fields.number("dip_rad", kDip_rad);
  sample.turn_rate_rad_s = fields.number("turn_rate_rad_s", kRate_rad_s);
  sample.temperature_C = fields.number("temperature_C", kTemperature_C);
  sample.heading_std_rad = fields.number("heading_std_rad", kError);
  sample.tilt_std_rad = fields.number("tilt_std_rad", kError);
  sample.field_std_uT = fields.number("field_std_uT", kError);
  if (const auto error = fields.text("error")) {
    std::uint32_t code = 0;
    const auto [end, failed] = std::from_chars(error->data(), error->data() + error->size(), code, 16);
    if (failed != std::errc{} || end != error->data() + error->size()) fields.refuse();
    sample.error = code;
  }
  const bool has_any = sample.heading_rad || sample.pitch_rad || sample.roll_rad || sample.field_body_uT ||
                       sample.dip_rad || sample.turn_rate_rad_s || sample.temperature_C || sample.error;
  return has_any ? Found(sample) : std::nullopt;
}

Found read_imu(Fields& fields) {
  ImuSample sample;
  sample.rate_rad_s = fields.vector("rate_rad_s", kRate_rad_s);
  sample.yaw_rate_b_rad_s = fields.number("yaw_rate_b_rad_s", kRate_rad_s);
  sample.specific_force_m_s2 = fields.vector("specific_force_m_s2", kForce_m_s2);
  sample.depth_m = fields.number("depth_m", kDepth_m);
  sample.temperature_C = fields.number("temperature_C", kTemperature_C);
  sample.over_range = fields.boolean("over_range").value_or(false);
  sample.rate_std_rad_s = fields.number("rate_std_rad_s", kError);
  sample.specific_force_std_m_s2 = fields.number("specific_force_std_m_s2", kError);
  sample.depth_std_m = fields.number("depth_std_m", kError);
  if (const auto sequence = count(fields, "sequence")) {
    sample.card =
        CardState{*sequence, fields.boolean("leak_forward").value_or(false),
                  fields.boolean("leak_aft").value_or(false), fields.boolean("low_supply").value_or(false)};
  }
  const bool has_any = sample.rate_rad_s || sample.yaw_rate_b_rad_s || sample.specific_force_m_s2 ||
                       sample.depth_m || sample.temperature_C || sample.card;
  return has_any ? Found(sample) : std::nullopt;
}

std::optional<Fix> fix_named(std::string_view name) {
  for (const Fix fix :
       {Fix::none, Fix::fix_2d, Fix::fix_3d, Fix::propagated, Fix::hold, Fix::acquiring, Fix::bad_geometry}) {
    if (name_of(fix) == name) return fix;
  }
  return std::nullopt;
}

Found read_gps(Fields& fields) {
  GpsSample sample;
  sample.time_utc_ns = fields.nanoseconds("time");
  sample.latitude_rad = radians(fields.number("lat", kLatitude_deg));
  sample.longitude_rad = radians(fields.number("lon", kLongitude_deg));
  if (sample.latitude_rad.has_value() != sample.longitude_rad.has_value()) fields.refuse();
  sample.height_m = fields.number("height_m", kHeight_m);
  sample.height_msl_m = fields.number("height_msl_m", kHeight_m);
  sample.speed_m_s = fields.number("speed_m_s", kGroundSpeed_m_s);
  sample.course_rad = heading(fields, "course_rad");
  sample.climb_m_s = fields.number("climb_m_s", kSpeed_m_s);
  sample.dop = fields.number("dop", kDop);
  sample.visible = count(fields, "visible");
  sample.tracked = count(fields, "tracked");
  sample.time_corrected = fields.boolean("time_corrected").value_or(false);
  sample.leap_known = fields.boolean("leap_known").value_or(true);
  sample.position_std_m = fields.number("position_std_m", kError);
  sample.height_std_m = fields.number("height_std_m", kError);
  sample.velocity_std_m_s = fields.number("velocity_std_m_s", kError);
  if (const auto name = fields.text("fix")) {
    const auto fix = fix_named(*name);
    if (!fix) fields.refuse();
    sample.fix = fix.value_or(Fix::none);
  } else if (sample.latitude_rad) {
    // A position from elsewhere (acoustics, a survey) has no satellites; that it is sent says that it counts.
    sample.fix = sample.height_m || sample.height_msl_m ? Fix::fix_3d : Fix::fix_2d;
  }
  return sample;
}

Found read_motor(Fields& fields) {
  MotorSample sample;
  sample.rpm_commanded = fields.number("rpm_commanded", kTurns_min);
  sample.rpm = fields.number("rpm", kTurns_min);
  sample.fins_rad = fields.three("fins_rad", kFin_rad);
  sample.current_A = fields.number("current_A", kCurrent_A);
  sample.sequence = count(fields, "sequence");
  sample.fins_std_rad = fields.number("fins_std_rad", kError);
  sample.current_std_A = fields.number("current_std_A", kError);
  const bool has_fin =
      std::any_of(sample.fins_rad.begin(), sample.fins_rad.end(), [](const auto& fin) { return fin.has_value(); });
  return sample.rpm_commanded || sample.rpm || sample.current_A || has_fin ? Found(sample) : std::nullopt;
}

Found read_altimeter(Fields& fields) {
  const auto altitude_m = fields.number("altitude_m", kAltitude_m);
  const auto std_m = fields.number("altitude_std_m", kError);
  return altitude_m ? Found(AltimeterSample{*altitude_m, std_m}) : std::nullopt;
}

Found read_power(Fields& fields) {
  PowerSample sample;
  sample.voltage_V = fields.number("voltage_V", kVoltage_V);
  sample.current_A = fields.number("current_A", kCurrent_A);
  return sample.voltage_V || sample.current_A ? Found(sample) : std::nullopt;
}

Found read_dvl(Fields& fields) {
  DvlSample sample;
  const auto frame = fields.text("frame");
  if (frame && *frame != "body" && *frame != "earth") fields.refuse();
  sample.frame = frame == "earth" ? VelocityFrame::earth : VelocityFrame::body;
  sample.bottom_velocity_m_s = fields.vector("bottom_velocity_m_s", kSpeed_m_s);
  sample.bottom_velocity_std_m_s = fields.number("bottom_velocity_std_m_s", kError);
  sample.water_velocity_m_s = fields.vector("water_velocity_m_s", kSpeed_m_s);
  sample.water_velocity_std_m_s = fields.number("water_velocity_std_m_s", kError);
  sample.altitude_m = fields.number("altitude_m", kAltitude_m);
  sample.altitude_std_m = fields.number("altitude_std_m", kError);
  sample.temperature_C = fields.number("temperature_C", kTemperature_C);
  sample.sound_speed_m_s = fields.number("sound_speed_m_s", kSound_m_s);
  return sample;  // one without any velocity says that the bottom is lost
}

Found read_depth(Fields& fields) {
  DepthSample sample;
  sample.depth_m = fields.number("depth_m", kDepth_m);
  sample.depth_std_m = fields.number("depth_std_m", kError);
  sample.pressure_Pa = fields.number("pressure_Pa", kPressure_Pa);
  sample.pressure_std_Pa = fields.number("pressure_std_Pa", kError);
  sample.temperature_C = fields.number("temperature_C", kTemperature_C);
  return sample.depth_m || sample.pressure_Pa || sample.temperature_C ? Found(sample) : std::nullopt;
}

Found read_sensor(Fields& fields) {
  const auto quantity = fields.text("quantity"), unit = fields.text("unit");
  const auto value = fields.number("value", kAny);
  ScalarSample sample;
  sample.value_std = fields.number("value_std", kError);
  if (!value) return std::nullopt;
  if (!quantity || quantity->empty()) fields.refuse();
  sample.quantity = decltype(sample.quantity)(quantity.value_or(""));
  sample.unit = decltype(sample.unit)(unit.value_or(""));
  sample.value = *value;
  return sample;
}

struct ClassReader {
  std::string_view name;
  Found (*read)(Fields&);
};
constexpr std::array kReaders{ClassReader{"COMPASS", read_compass},
                              ClassReader{"IMU", read_imu},
                              ClassReader{"GPS", read_gps},
                              ClassReader{"MOTOR", read_motor},
                              ClassReader{"ALTIMETER", read_altimeter},
                              ClassReader{"POWER", read_power},
                              ClassReader{"DVL", read_dvl},
                              ClassReader{"DEPTH", read_depth},
                              ClassReader{"SENSOR", read_sensor}};

/// Other lines of navcal: a recording that is injected again contains them.
constexpr std::array<std::string_view, 8> kNoMeasurements{"SKY",         "NAV",   "BATTERY", "CALIB",
                                                          "CALIBRATION", "EVENT", "COMMAND", "TIME"};

}  // namespace

Instrument::Verdict InjectedSamples::read(const protocols::Frame& frame, Receiver& receiver) {
  const auto object = Object::parse(frame.bytes);
  if (!object) return Verdict::out_of_range;
  Fields fields(*object);
  const std::string name = fields.text("class").value_or("");
  if (std::find(kNoMeasurements.begin(), kNoMeasurements.end(), name) != kNoMeasurements.end())
    return Verdict::ignored;
  const auto reader =
      std::find_if(kReaders.begin(), kReaders.end(), [&](const ClassReader& of) { return of.name == name; });
  if (reader == kReaders.end()) return Verdict::out_of_range;
  const Found found = reader->read(fields);
  SenderTime time;
  time.utc_ns = fields.nanoseconds("time");
  time.std_ns = fields.nanoseconds("time_std");
  if (!fields.all_good()) return Verdict::out_of_range;
  if (!found) return Verdict::ignored;
  Measurement measurement;
  measurement.value = *found;
  measurement.paces = false;
  measurement.by_sender = time;
  receiver.on_measurement(measurement);
  return Verdict::used;
}

}  // namespace navcal::instruments

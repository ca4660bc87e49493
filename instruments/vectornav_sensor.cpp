// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "instruments/devices.h"
#include "protocols/vectornav_lines.h"

namespace navcal::instruments {
namespace {

namespace vn = protocols::vectornav;
using vn::Triple;

// Beyond what any model of the family measures: 2000 deg/s, 16 g, 8 gauss.
constexpr double kMaxRate_rad_s = 40, kMaxForce_m_s2 = 400, kMaxVnField_uT = 1000;
constexpr double kLeastInside_C = -60, kMostInside_C = 130, kMostInside_Pa = 200'000;
// Angles may be rounded up to their limit.
constexpr double kYawLimit_deg = 360.001, kPitchLimit_deg = 90.001, kRollLimit_deg = 180.001;

/// Absent, or finite and not beyond the limit.
bool is_absent_or_within(const std::optional<Triple>& values, double limit) {
  return !values || std::all_of(values->begin(), values->end(), [limit](double value) {
    return std::isfinite(value) && std::abs(value) <= limit;
  });
}

bool can_be(const vn::Reading& reading) {
  const auto& angles = reading.yaw_pitch_roll_deg;
  const bool angles_can_be =
      is_absent_or_within(angles, kYawLimit_deg) &&
      (!angles || (std::abs((*angles)[1]) <= kPitchLimit_deg && std::abs((*angles)[2]) <= kRollLimit_deg));
  const bool inside_can_be =
      (!reading.temperature_C ||
       (*reading.temperature_C >= kLeastInside_C && *reading.temperature_C <= kMostInside_C)) &&
      (!reading.pressure_Pa || (*reading.pressure_Pa >= 0 && *reading.pressure_Pa <= kMostInside_Pa));
  return angles_can_be && inside_can_be && is_absent_or_within(reading.rate_rad_s, kMaxRate_rad_s) &&
         is_absent_or_within(reading.raw_rate_rad_s, kMaxRate_rad_s) &&
         is_absent_or_within(reading.acceleration_m_s2, kMaxForce_m_s2) &&
         is_absent_or_within(reading.raw_acceleration_m_s2, kMaxForce_m_s2) &&
         is_absent_or_within(reading.field_uT, kMaxVnField_uT) &&
         is_absent_or_within(reading.raw_field_uT, kMaxVnField_uT) &&
         is_absent_or_within(reading.yaw_pitch_roll_std_deg, kYawLimit_deg);
}

std::optional<ImuSample> imu_of(const vn::Reading& reading) {
  ImuSample sample;
  sample.rate_rad_s = reading.rate_rad_s ? reading.rate_rad_s : reading.raw_rate_rad_s;
  sample.specific_force_m_s2 =
      reading.acceleration_m_s2 ? reading.acceleration_m_s2 : reading.raw_acceleration_m_s2;
  sample.temperature_C = reading.temperature_C;
  if (!sample.rate_rad_s && !sample.specific_force_m_s2) return std::nullopt;
  return sample;
}

std::optional<CompassSample> compass_of(const vn::Reading& reading) {
  CompassSample sample;
  sample.field_body_uT = reading.field_uT ? reading.field_uT : reading.raw_field_uT;
  if (const auto& angles = reading.yaw_pitch_roll_deg) {
    sample.heading_rad = base::as_heading((*angles)[0] * base::kRadiansPerDegree);
    sample.pitch_rad = (*angles)[1] * base::kRadiansPerDegree;
    sample.roll_rad = (*angles)[2] * base::kRadiansPerDegree;
    if (const auto& std_deg = reading.yaw_pitch_roll_std_deg) {
      sample.heading_std_rad = (*std_deg)[0] * base::kRadiansPerDegree;
      sample.tilt_std_rad = std::max((*std_deg)[1], (*std_deg)[2]) * base::kRadiansPerDegree;
    }
  }
  if (!sample.field_body_uT && !sample.heading_rad) return std::nullopt;
  return sample;
}

Verdict hand_over_reading(const vn::Reading& reading, Receiver& receiver) {
  if (!can_be(reading)) return Verdict::out_of_range;
  std::optional<std::int64_t> device_time_ns;
  if (reading.since_startup_ns) device_time_ns = static_cast<std::int64_t>(*reading.since_startup_ns);
  bool used = false;
  const auto give = [&](const Value& value) {
    receiver.on_measurement({.value = value, .device_time_ns = device_time_ns, .paces = !used});
    used = true;
  };
  if (const auto imu = imu_of(reading)) give(*imu);
  if (const auto compass = compass_of(reading)) give(*compass);
  // The gauge is inside the sensor: the pressure is that of the housing's air, and no depth.
  if (reading.pressure_Pa && used)
    give(ScalarSample{Text<24>("air pressure"), Text<16>("Pa"), *reading.pressure_Pa, std::nullopt});
  return used ? Verdict::used : Verdict::ignored;
}

}  // namespace

/// VectorNav VN-100, VN-200, VN-300: rates and specific force, attitude and field, and the air pressure inside the
/// sensor. Compensated values are preferred to uncompensated ones of the same message. Yaw is taken for magnetic,
/// as it is with the settings of the factory (ICD section 12).
Verdict read_vectornav(const protocols::Frame& frame, const config::PortSettings&, Receiver& receiver) {
  if (frame.id == vn::kBinary) {
    const auto reading = vn::decode_binary(frame.bytes);
    return reading ? hand_over_reading(*reading, receiver) : Verdict::ignored;
  }
  const auto reading = vn::decode_line(frame.bytes);
  return reading ? hand_over_reading(*reading, receiver) : Verdict::ignored;
}

}  // namespace navcal::instruments

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "instruments/devices.h"
#include "protocols/tcm2_word.h"
#include "protocols/trax.h"

namespace navcal::instruments {
namespace {

namespace trax = protocols::trax;

constexpr double kMostField = 1000, kMostAcceleration_m_s2 = 100, kMostTemperature_C = 150;

bool is_between(const std::optional<double>& value, double least, double greatest) {
  return !value || (*value >= least && *value <= greatest);
}

/// Not-a-number lies between nothing.
bool is_possible_data(const trax::Data& data) {
  const auto all = [](const auto& axes, double most) {
    return std::all_of(axes.begin(), axes.end(), [&](const auto& axis) { return is_between(axis, -most, most); });
  };
  return is_between(data.heading_deg, 0, 360) && is_between(data.pitch_deg, -90, 90) &&
         is_between(data.roll_deg, -180, 180) &&
         is_between(data.temperature_C, -kMostTemperature_C, kMostTemperature_C) &&
         all(data.field_uT, kMostField) && all(data.acceleration_m_s2, kMostAcceleration_m_s2);
}

std::optional<Vector3> vector_of_axes(const std::array<std::optional<double>, 3>& axes) {
  if (!axes[0] || !axes[1] || !axes[2]) return std::nullopt;
  return Vector3{*axes[0], *axes[1], *axes[2]};
}

/// Specific force: -9.81 in z when level and still. The sign of the device's axes is not known from a source at
/// hand; its own roll and pitch show where down is. nullopt without them, and in free fall.
std::optional<Vector3> specific_force(const Vector3& acceleration_m_s2, const CompassSample& compass) {
  if (!compass.roll_rad || !compass.pitch_rad) return std::nullopt;
  const double cos_pitch = std::cos(*compass.pitch_rad);
  const Vector3 down{-std::sin(*compass.pitch_rad), std::sin(*compass.roll_rad) * cos_pitch,
                     std::cos(*compass.roll_rad) * cos_pitch};
  double along_m_s2 = 0;
  for (std::size_t i = 0; i < 3; ++i) along_m_s2 += down[i] * acceleration_m_s2[i];
  if (along_m_s2 == 0) return std::nullopt;
  Vector3 force_m_s2 = acceleration_m_s2;
  if (along_m_s2 > 0) {
    for (double& axis : force_m_s2) axis = -axis;
  }
  return force_m_s2;
}

}  // namespace

/// PNI TRAX, TCM3 and Prime (ICD section 11): heading, tilt, field and temperature as CompassSample, acceleration
/// as ImuSample of the same time. The heading is taken for magnetic, as the start-up dialogue sets it. Distortion
/// is a remark, as the TCM2's E001. The device's heading status is not used: no source at hand says what it means.
Verdict read_pni(const protocols::Frame& frame, const config::PortSettings&, Receiver& receiver) {
  if (frame.id != trax::id_of(static_cast<std::uint8_t>(trax::FrameNumber::data))) return Verdict::ignored;
  const auto data = trax::decode_data(frame.bytes);
  if (!data || !is_possible_data(*data)) return Verdict::out_of_range;
  const auto radians = [](const std::optional<double>& degrees) -> std::optional<double> {
    if (!degrees) return std::nullopt;
    return *degrees * base::kRadiansPerDegree;
  };
  CompassSample compass;
  if (data->heading_deg) compass.heading_rad = base::as_heading(*data->heading_deg * base::kRadiansPerDegree);
  compass.pitch_rad = radians(data->pitch_deg);
  compass.roll_rad = radians(data->roll_deg);
  compass.field_body_uT = vector_of_axes(data->field_uT);
  compass.temperature_C = data->temperature_C;
  if (data->distorted.value_or(false)) compass.error = protocols::tcm2::error::kDistortion;
  if (!compass.heading_rad && !compass.field_body_uT && !compass.pitch_rad && !compass.roll_rad) {
    return Verdict::ignored;
  }
  hand_over(compass, receiver);
  const auto acceleration_m_s2 = vector_of_axes(data->acceleration_m_s2);
  if (!acceleration_m_s2) return Verdict::used;
  if (const auto force_m_s2 = specific_force(*acceleration_m_s2, compass)) {
    ImuSample imu;
    imu.specific_force_m_s2 = force_m_s2;
    hand_over(imu, receiver, false);
  }
  return Verdict::used;
}

}  // namespace navcal::instruments

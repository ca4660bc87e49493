// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/compass.h"

#include "protocols/tcm2_word.h"

namespace navcal::reference {
namespace {

constexpr double kCompassPeriod_s = 0.1, kCompassLatency_s = 0.05;
constexpr double kFluid_s = 0.3;
constexpr double kMemory_s = 60;
constexpr double kSubstep_s = 0.004;
constexpr double kFieldNoise_uT = 0.15, kTiltNoise_deg = 0.1, kTemperatureNoise_C = 0.1;

/// Turns a vector from the housing's axes to those of a triad that is turned by this rotation vector.
Eigen::Matrix3d to_turned_triad(const Vector3& turned_rad) {
  const double angle = turned_rad.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(-angle, turned_rad / angle).toRotationMatrix();
}

Eigen::Matrix3d iron(const CompassDeviations& deviations) {
  const auto& s = deviations.soft_iron;
  Eigen::Matrix3d S;
  S << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
  return to_turned_triad(deviations.misalignment_rad) * (Eigen::Matrix3d::Identity() + S);
}

}  // namespace

Compass::Compass(const Fitting& fitting, const CompassDeviations& deviations, const Vector3& field_uT)
    : Instrument(fitting, Port::compass, kCompassPeriod_s, kCompassLatency_s), departures_(deviations),
      field_world_uT_(Eigen::AngleAxisd(deviations.declination_rad, Vector3::UnitZ()) * field_uT),
      iron_(iron(deviations)) {}

void Compass::sense(const Snapshot& s, double after_s) {
  const Vector3 body_uT = s.world_from_body.conjugate() * field_world_uT_;
  Vector3 m = iron_ * body_uT + departures_.hard_iron_uT + departures_.motor_field_uT_per_A * s.motor_current_A +
              departures_.temperature_uT_per_K * (s.electronics_C - kReferenceTemperature_C) +
              departures_.hysteresis * memory_.feed(after_s, kMemory_s, body_uT);
  m.array() *= 1 - departures_.saturation_per_uT2 * m.array().square();
  const double heading = s.heading_rad();
  const Eigen::Vector2d& by_heading = departures_.lag_by_heading_s;
  const double lag_s = departures_.lag_s + by_heading.norm() +
                       by_heading.dot(Eigen::Vector2d(std::cos(heading), std::sin(heading)));
  field_.feed(after_s, lag_s, m);

  const Vector3& a = s.acceleration_m_s2;
  const Eigen::Vector2d slosh = departures_.slosh / kGravity_m_s2 * Eigen::Vector2d(-a.y(), a.x());
  tilt_.feed(after_s, kFluid_s, Eigen::Vector2d(s.roll_rad(), s.pitch_rad()) + slosh);
}

void Compass::settle(const History& history, double time_s) {
  if (sensed_s_ == 0) sense(history.at(0), 0);
  const int steps = static_cast<int>(std::ceil((time_s - sensed_s_) / kSubstep_s));
  const double begin_s = sensed_s_;
  for (int i = 1; i <= steps; ++i) {
    const double next_s = begin_s + (time_s - begin_s) * i / steps;
    sense(history.at(next_s), next_s - sensed_s_);
    sensed_s_ = next_s;
  }
}

std::vector<std::uint8_t> Compass::sample(const History& history, double time_s) {
  settle(history, time_s);
  const Vector3 m = field_.output() + noise3(kFieldNoise_uT);
  const double roll = tilt_.output()(0) + departures_.tilt_offset_rad[0] + noise(kTiltNoise_deg * kDegree);
  const double pitch = tilt_.output()(1) + departures_.tilt_offset_rad[1] + noise(kTiltNoise_deg * kDegree);
  // The horizontal axes of the housing as the inclinometer has them.
  const double ahead =
      m.x() * std::cos(pitch) + (m.y() * std::sin(roll) + m.z() * std::cos(roll)) * std::sin(pitch);
  const double aside = m.y() * std::cos(roll) - m.z() * std::sin(roll);
  const double heading = std::atan2(-aside, ahead);
  reading_ = {heading, pitch, roll};

  protocols::tcm2::Word word;
  const double tenths = std::round(heading / kDegree * 10);
  word.heading = std::fmod(tenths + 3600, 3600) / 10;
  word.pitch = pitch / kDegree;
  word.roll = roll / kDegree;
  word.x = m.x();
  word.y = m.y();
  word.z = m.z();
  word.temperature = history.at(time_s).electronics_C + noise(kTemperatureNoise_C);
  return protocols::tcm2::encode_word(word);
}

}  // namespace navcal::reference

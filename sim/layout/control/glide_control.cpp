// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/control/glide_control.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/gravity.h"
#include "sim/layout/vector_of.h"

namespace navcal::sim {
namespace {

constexpr double kGlide_rad = 25 * base::kRadiansPerDegree;
constexpr double kAhead_s = 20;
constexpr double kFull_m = 2;

double speed_down(const Body& body) { return body.velocity.head<3>().dot(down_of(body.euler_rad)); }

}  // namespace

GlideControl::GlideControl(const LayoutVehicle& vehicle) : layout_(vehicle.layout()) {
  const Restoring restoring = vehicle.hold(ActuatorValues::neutral(layout_)).restoring;
  stiffness_Nm_ = restoring.arm_Nm.z();
  net_weight_N_ = restoring.net_weight_N;
}

void GlideControl::command(double depth_demanded_m, const Body& body, double period_s, ActuatorValues& commands) {
  const double error_m = depth_demanded_m - body.position_m.z() - kAhead_s * speed_down(body);
  const double part = std::clamp(error_m / kFull_m, -1.0, 1.0);
  double range_N = 0;
  for (const config::LayoutBallast& ballast : layout_.ballasts) range_N += (ballast.high_N - ballast.low_N) / 2;
  // What is out of balance is taken back first, by all ballasts in the same part of their range.
  const double light = range_N > 0 ? std::clamp(net_weight_N_ / range_N - part, -1.0, 1.0) : 0;
  for (std::size_t i = 0; i < layout_.ballasts.size(); ++i) {
    const config::LayoutBallast& ballast = layout_.ballasts[i];
    commands.ballasts_N[i] = (ballast.high_N + ballast.low_N) / 2 + light * (ballast.high_N - ballast.low_N) / 2;
  }
  const double pitch_rad = -kGlide_rad * part;
  const double pitch_error_rad = pitch_rad - body.euler_rad.y();
  constexpr double kIntegral_per_s = 0.02, kMost_rad = 10 * base::kRadiansPerDegree;
  pitch_integral_ =
      std::clamp(pitch_integral_ + kIntegral_per_s * pitch_error_rad * period_s, -kMost_rad, kMost_rad);
  double moment_m_kg = 0;
  for (const config::LayoutMovingMass& mass : layout_.moving_masses)
    moment_m_kg += mass.mass_kg * std::abs(vector_of(mass.axis).normalized().x());
  if (!(moment_m_kg > 0)) return;
  // A mass s ahead turns the nose down by m g s cos pitch; weight and buoyancy turn it back by W h sin pitch.
  const double way_m =
      -stiffness_Nm_ * std::tan(pitch_rad + pitch_integral_) / (moment_m_kg * base::kGravity_m_s2);
  for (std::size_t i = 0; i < layout_.moving_masses.size(); ++i) {
    const config::LayoutMovingMass& mass = layout_.moving_masses[i];
    const double ahead = vector_of(mass.axis).normalized().x();
    commands.masses_m[i] = std::clamp(ahead < 0 ? -way_m : way_m, mass.low_m, mass.high_m);
  }
}

}  // namespace navcal::sim

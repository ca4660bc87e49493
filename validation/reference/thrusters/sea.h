// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "validation/reference/hull.h"
#include "validation/reference/parameter_deviations.h"
#include "validation/reference/rng.h"

namespace navcal::reference::thrusters {

/// The water around a vehicle: a current that changes slowly, a swell of one period, the local gravity. North,
/// east, down.
class Sea {
 public:
  /// Still, with the gravity of kGravity_m_s2.
  Sea() = default;
  /// By the dice: phases, periods and direction. Amplitudes in m/s and m.
  Sea(double latitude_rad, double current_m_s, double wave_m, Rng& dice);

  void set_current(const Eigen::Vector2d& steady_m_s) { steady_m_s_ = steady_m_s; }
  void add_wave(double amplitude_m) { wave_m_ += amplitude_m; }

  /// Its acceleration is neglected: below 1e-4 m/s2.
  [[nodiscard]] Eigen::Vector2d current_m_s(double time_s) const;
  /// Acceleration of the water by the swell, deep-water theory (Airy), m/s2.
  [[nodiscard]] Vector3 wave_acceleration_m_s2(const Vector3& position_m, double time_s) const;
  /// Height of the surface above the mean, m.
  [[nodiscard]] double surface_m(const Vector3& position_m, double time_s) const;
  [[nodiscard]] double gravity_m_s2() const { return gravity_m_s2_; }

 private:
  [[nodiscard]] double phase(const Vector3& position_m, double time_s) const;

  double gravity_m_s2_ = kGravity_m_s2;
  Eigen::Vector2d steady_m_s_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d swing_m_s_ = Eigen::Vector2d::Zero();
  double swing_rad_s_ = 0, swing_phase_ = 0;
  double wave_m_ = 0, wave_rad_s_ = 1.5, wave_phase_ = 0;
  Eigen::Vector2d wave_direction_{1, 0};
};

/// At the ellipsoid (WGS84, formula of Somigliana), m/s2.
[[nodiscard]] double gravity_at(double latitude_rad);

}  // namespace navcal::reference::thrusters

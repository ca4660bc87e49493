// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/sea.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::reference::thrusters {

double gravity_at(double latitude_rad) {
  const double sine2 = std::sin(latitude_rad) * std::sin(latitude_rad);
  return 9.7803253359 * (1 + 0.00193185265241 * sine2) / std::sqrt(1 - 0.00669437999014 * sine2);
}

Sea::Sea(double latitude_rad, double current_m_s, double wave_m, Rng& dice)
    : gravity_m_s2_(gravity_at(latitude_rad)), wave_m_(wave_m) {
  const auto towards = [&](double size) -> Eigen::Vector2d {
    const double angle = dice.uniform(0, 2 * std::numbers::pi);
    return size * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  swing_m_s_ = towards(current_m_s);
  swing_rad_s_ = 2 * std::numbers::pi / dice.uniform(200, 800);
  swing_phase_ = dice.uniform(0, 2 * std::numbers::pi);
  wave_direction_ = towards(1);
  wave_rad_s_ = 2 * std::numbers::pi / dice.uniform(3, 6);
  wave_phase_ = dice.uniform(0, 2 * std::numbers::pi);
}

Eigen::Vector2d Sea::current_m_s(double time_s) const {
  return steady_m_s_ + std::sin(swing_rad_s_ * time_s + swing_phase_) * swing_m_s_;
}

double Sea::phase(const Vector3& position_m, double time_s) const {
  const double number = wave_rad_s_ * wave_rad_s_ / gravity_m_s2_;
  return number * wave_direction_.dot(position_m.head<2>()) - wave_rad_s_ * time_s + wave_phase_;
}

double Sea::surface_m(const Vector3& position_m, double time_s) const {
  return wave_m_ == 0 ? 0 : wave_m_ * std::cos(phase(position_m, time_s));
}

Vector3 Sea::wave_acceleration_m_s2(const Vector3& position_m, double time_s) const {
  if (wave_m_ == 0) return Vector3::Zero();
  const double number = wave_rad_s_ * wave_rad_s_ / gravity_m_s2_;
  const double size = wave_m_ * wave_rad_s_ * wave_rad_s_ * std::exp(-number * std::max(position_m.z(), 0.0));
  const double angle = phase(position_m, time_s);
  const Eigen::Vector2d along = size * std::sin(angle) * wave_direction_;
  return {along.x(), along.y(), size * std::cos(angle)};
}

}  // namespace navcal::reference::thrusters

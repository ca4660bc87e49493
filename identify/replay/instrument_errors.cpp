// SPDX-License-Identifier: Apache-2.0
#include "identify/replay/instrument_errors.h"

#include <cmath>

#include "base/gravity.h"
#include "sim/effects/effect_table.h"

namespace navcal::identify {
namespace {

sim::Vector3 array_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Vector3d vector_of(const sim::Vector3& v) { return {v[0], v[1], v[2]}; }

sim::State state_of(const sim::Body& body, const Eigen::Vector3d& force_m_s2) {
  sim::State state;
  state.position_m = array_of(body.position_m);
  state.euler_rad = array_of(body.euler_rad);
  state.velocity_body_m_s = array_of(body.velocity.head<3>());
  state.rate_rad_s = array_of(body.velocity.tail<3>());
  state.specific_force_m_s2 = array_of(force_m_s2);
  return state;
}

}  // namespace

Eigen::Vector3d field_in_body(const Eigen::Vector3d& euler_rad, double dip_rad) {
  return world_from_body(euler_rad).transpose() * Eigen::Vector3d(std::cos(dip_rad), 0, std::sin(dip_rad));
}

double levelled_heading(const Eigen::Vector3d& field, const Eigen::Vector2d& tilt_rad) {
  const double sr = std::sin(tilt_rad.x()), cr = std::cos(tilt_rad.x());
  const double sp = std::sin(tilt_rad.y()), cp = std::cos(tilt_rad.y());
  return std::atan2(-(field.y() * cr - field.z() * sr),
                    field.x() * cp + field.y() * sr * sp + field.z() * cr * sp);
}

Eigen::Vector3d specific_force(const MotionPoint& point, const Eigen::Vector3d& down,
                               const Eigen::Vector3d& place_m) {
  const Eigen::Vector3d v = point.body.velocity.head<3>(), omega = point.body.velocity.tail<3>();
  const Eigen::Vector3d angular = point.acceleration.tail<3>();
  return Eigen::Vector3d(point.acceleration.head<3>()) + omega.cross(v) + angular.cross(place_m) +
         omega.cross(omega.cross(place_m)) - base::kGravity_m_s2 * down;
}

InstrumentErrors::InstrumentErrors(const std::map<std::string_view, std::vector<double>>& parameters) {
  if (parameters.empty()) return;
  effects_ = std::make_shared<sim::EffectSet>();
  for (const auto& [name, first] : parameters) {
    sim::Effect& effect = effects_->add(sim::make_effect(name));
    std::vector<double> values = first;
    values.resize(effect.parameters().size());
    effect.set_parameters(values);
  }
  usual_tilt_ = felt_tilt(sim::Body{}, sim::Vector6::Ones());
}

std::array<double, 4> InstrumentErrors::of_rates(const sim::Body& body, const Eigen::Vector3d& force_m_s2) const {
  if (empty()) return {};
  const sim::State state = state_of(body, force_m_s2);
  const auto true_rate = [&](std::size_t gyro) { return state.rate_rad_s[sim::kGyroAxes[gyro]]; };
  sim::GyroRates rates;
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = true_rate(i);
  effects_->gyros({0, state}, rates);
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] -= true_rate(i);
  return {rates[0], rates[2], rates[1], rates[3]};
}

Eigen::Vector3d InstrumentErrors::shown_field(const Eigen::Vector3d& field_uT) const {
  if (empty()) return field_uT;
  sim::Vector3 shown_uT = array_of(field_uT);
  const sim::State state;
  effects_->body_field({0, state}, shown_uT);
  return vector_of(shown_uT);
}

Eigen::Vector2d InstrumentErrors::felt_tilt(const sim::Body& body, const sim::Vector6& acceleration) const {
  if (empty()) return Eigen::Vector2d::Zero();
  const Eigen::Vector3d down = sim::down_of(body.euler_rad);
  const sim::State state = state_of(body, specific_force({body, acceleration, {}}, down, Eigen::Vector3d::Zero()));
  sim::Tilt felt;
  effects_->tilt_seen({0, state}, felt);
  return {felt.roll_rad, felt.pitch_rad};
}

}  // namespace navcal::identify

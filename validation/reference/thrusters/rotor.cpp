// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/rotor.h"

#include <algorithm>
#include <numbers>

namespace navcal::reference::thrusters {
namespace {

/// Thrust over the area of the disc at full speed, where the layout states no diameter: that of a small ROV's.
constexpr double kDiscLoad_Pa = 11e3;
constexpr double kLeastWake = 0.05;

double polynomial(const std::vector<double>& coefficients, double x) {
  double sum = 0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) sum = sum * x + *c;
  return sum;
}

double steady_voltage(double speed, double resistance) {
  return (1 - resistance) * speed + resistance * speed * std::abs(speed);
}

}  // namespace

Rotor::Rotor(const PlannedThruster& thruster, double density_kg_m3, const RotorDeviations& deviations,
             const Nature& nature)
    : thruster_(thruster), density_kg_m3_(density_kg_m3), deviations_(deviations), nature_(nature),
      place_m_(thruster.place_m), direction_(thruster.direction),
      forward_N_(std::abs(thruster.bollard_N(thruster.high, density_kg_m3))),
      reverse_N_(std::abs(thruster.bollard_N(thruster.low, density_kg_m3))) {
  const double full_N = std::max({forward_N_, reverse_N_, 1e-6});
  duct_m_ =
      thruster.diameter_m > 0 ? thruster.diameter_m : std::sqrt(full_N / kDiscLoad_Pa * 4 / std::numbers::pi);
  jet_m_s_ = std::sqrt(full_N / (2 * density_kg_m3 * std::numbers::pi / 4 * duct_m_ * duct_m_));
  full_torque_Nm_ = full_N * thruster.torque_arm_m;
  if (thruster.diameter_m > 0 && !thruster.KQ.empty()) {
    const double n = thruster.high / 60;
    full_torque_Nm_ = density_kg_m3 * n * n * std::pow(thruster.diameter_m, 5) * thruster.KQ.front();
  }
}

double Rotor::steady_speed(double command) const {
  const double thrust_N = thruster_.bollard_N(command, density_kg_m3_);
  const double full_N = thrust_N < 0 ? reverse_N_ : forward_N_;
  if (thrust_N == 0 || full_N == 0) return 0;
  return std::copysign(std::sqrt(std::min(std::abs(thrust_N) / full_N, 1.0)), thrust_N);
}

void Rotor::order(double command) {
  const double neutral = thruster_.neutral();
  const double half_range = std::max(thruster_.high - neutral, neutral - thruster_.low);
  double away = command - neutral + deviations_.offset * half_range;
  if (deviations_.reversed) away = -away;
  if (std::abs(away) < thruster_.dead_band + deviations_.dead_band * half_range) away = 0;
  ordered_voltage_ = deviations_.dead ? 0 : steady_voltage(steady_speed(neutral + away), nature_.resistance);
  if (deviations_.lag_s <= 0) voltage_ = ordered_voltage_;
}

double Rotor::voltage(double after_s) const {
  if (deviations_.lag_s <= 0) return ordered_voltage_;
  return ordered_voltage_ + std::exp(-after_s / deviations_.lag_s) * (voltage_ - ordered_voltage_);
}

void Rotor::settle(double after_s) { voltage_ = voltage(after_s); }

Rotor::Rates Rotor::rates(double speed, double wake, double after_s, double sag) const {
  const double left = voltage(after_s) * (1 - sag) - steady_voltage(speed, nature_.resistance);
  const double pace = std::max({std::abs(speed), std::abs(wake), kLeastWake}) * jet_m_s_ / duct_m_;
  return {left / thruster_.lag_s, (speed - wake) * pace};
}

double Rotor::shaft_rev_s(double speed) const {
  return std::abs(speed) * (speed < 0 ? -thruster_.low : thruster_.high) / 60;
}

double Rotor::thrust_at_rest(double speed) const {
  return speed * std::abs(speed) * (speed < 0 ? reverse_N_ : forward_N_);
}

double Rotor::advanced(double at_rest_N, double speed, double advance_m_s) const {
  if (thruster_.diameter_m <= 0) {
    const double moving_N = at_rest_N - thruster_.advance_loss * std::sqrt(std::abs(at_rest_N)) * advance_m_s;
    return moving_N * at_rest_N < 0 ? 0 : moving_N;
  }
  const double n = shaft_rev_s(speed);
  if (n < 1e-6) return 0;
  const double J = std::max(advance_m_s, 0.0) / (n * thruster_.diameter_m);
  return at_rest_N * std::max(polynomial(thruster_.KT, J), 0.0) / thruster_.KT.front();
}

Push Rotor::push(double speed, double wake, double spin_up, double advance_m_s, double across_m_s,
                 double time_s) const {
  const double full_N = speed < 0 ? reverse_N_ : forward_N_;
  const double steady_N = advanced(thrust_at_rest(speed), speed, advance_m_s);
  const double jet2 = jet_m_s_ * jet_m_s_ * speed * speed;
  const double across2 = across_m_s * across_m_s;
  const double kept = 1 - nature_.jet_loss * across2 / (across2 + jet2 + 1e-9);
  const double fouled = std::max(1 - deviations_.fouling_per_s * time_s, 0.0);
  const double factor = (1 + deviations_.scale) * kept * fouled;

  Push push;
  push.force_N = factor * (steady_N + nature_.overshoot * full_N * std::abs(speed) * (speed - wake));
  double torque_Nm = push.force_N * thruster_.torque_arm_m;
  if (thruster_.diameter_m > 0) {
    const double n = shaft_rev_s(speed);
    const double J = n > 1e-6 ? std::max(advance_m_s, 0.0) / (n * thruster_.diameter_m) : 0;
    const double sense = speed < 0 ? -thruster_.reverse_efficiency : 1;
    torque_Nm =
        factor * sense * density_kg_m3_ * n * n * std::pow(thruster_.diameter_m, 5) * polynomial(thruster_.KQ, J);
  }
  torque_Nm += nature_.rotor_inertia * full_torque_Nm_ * thruster_.lag_s * spin_up;
  push.moment_Nm = thruster_.reaction_sign * thruster_.torque_share * torque_Nm;
  return push;
}

}  // namespace navcal::reference::thrusters

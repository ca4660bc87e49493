// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/vehicle.h"

#include <Eigen/LU>
#include <algorithm>
#include <numbers>

namespace navcal::reference {
namespace {

constexpr double kTideTurn_rad_s = 2 * std::numbers::pi / 1200;
constexpr double kWavePeriod_s = 4;
constexpr double kWaveDepth_m = 0.5;

}  // namespace

double motor_current_A(double shaft_rev_s) {
  const double n = std::max(shaft_rev_s, 0.0);
  return 0.15 + 5.5e-4 * n * n * n;
}

Vehicle::Vehicle(const Hull& hull, const VehicleDeviations& deviations, const Start& start, double longest_step_s)
    : hull_(hull), departures_(deviations), inertia_(inertia(hull)), inverse_inertia_(inertia_.inverse()),
      longest_step_s_(longest_step_s), fins_(hull.fin_time_s, deviations), shaft_rev_s_(start.shaft_rev_s),
      shaft_command_rev_s_(start.shaft_rev_s) {
  Vector6 nu;
  nu << start.velocity_m_s, start.rate_rad_s;
  y_ << start.position_m, start.world_from_body.normalized().coeffs(), inertia_ * nu;
}

void Vehicle::command(double shaft_rev_s, const Vector3& fins_rad) {
  shaft_command_rev_s_ = shaft_rev_s;
  fins_.command(fins_rad);
}

void Vehicle::hold(double shaft_rev_s, const Vector3& fins_rad) {
  shaft_rev_s_ = shaft_command_rev_s_ = shaft_rev_s;
  fins_.hold(fins_rad);
}

double Vehicle::shaft_rev_s(double after_s) const {
  return shaft_command_rev_s_ + std::exp(-after_s / hull_.shaft_time_s) * (shaft_rev_s_ - shaft_command_rev_s_);
}

Flow Vehicle::flow_of(const Coordinates& y) const {
  const Vector6 nu = inverse_inertia_ * y.tail<6>();
  return {nu.head<3>(), nu.tail<3>()};
}

Eigen::Vector2d Vehicle::current_m_s(double time_s) const {
  return departures_.current_m_s + Eigen::Rotation2Dd(kTideTurn_rad_s * time_s) * departures_.tide_m_s;
}

Wrench Vehicle::wrench(double after_s, const Coordinates& y, const Flow& flow, const Vector3& down) const {
  const double time_s = time_s_ + after_s, depth_m = y(2);
  const double fouling = 1 + departures_.fouling_per_s * time_s;
  const double crossflow = 1 + departures_.crossflow_per_m2 * depth_m * depth_m;
  const double thrust = (1 + departures_.thrust) * (1 - departures_.sag_per_C * charge_C_);
  Wrench sum = hull_wrench(hull_, flow, fouling, crossflow);
  sum += fin_wrench(hull_, flow, fins_.fins_rad(after_s), departures_.stall_loss);
  sum += propeller_wrench(hull_, flow.velocity_m_s.x(), shaft_rev_s(after_s), thrust, departures_.torque_leak);
  sum += static_wrench(hull_, down, departures_.lift_N);
  sum += damping_wrench(hull_, inertia_, flow.rate_rad_s, departures_.yaw_damping_per_s);
  sum(1) += departures_.wave_N * std::exp(-std::max(depth_m, 0.0) / kWaveDepth_m) *
            std::sin(2 * std::numbers::pi * time_s / kWavePeriod_s);
  return sum;
}

Vehicle::Coordinates Vehicle::slope(double after_s, const Coordinates& y) const {
  const Eigen::Quaterniond attitude(y.segment<4>(3));
  const Flow flow = flow_of(y);
  const Vector3 P = y.segment<3>(7), H = y.segment<3>(10), omega = flow.rate_rad_s;
  const Wrench tau = wrench(after_s, y, flow, attitude.conjugate() * Vector3::UnitZ());
  const Eigen::Vector2d current = current_m_s(time_s_ + after_s);

  Coordinates dy;
  dy.head<3>() = attitude * flow.velocity_m_s + Vector3(current.x(), current.y(), 0);
  dy.segment<4>(3) = 0.5 * (attitude * Eigen::Quaterniond(0, omega.x(), omega.y(), omega.z())).coeffs();
  dy.segment<3>(7) = P.cross(omega) + tau.head<3>();
  dy.segment<3>(10) = H.cross(omega) + P.cross(flow.velocity_m_s) + tau.tail<3>();
  return dy;
}

void Vehicle::step(double length_s) {
  y_ = dormand_prince(0.0, y_, length_s,
                      [this](double after_s, const Coordinates& y) { return slope(after_s, y); });
  y_.segment<4>(3).normalize();
  const double shaft = shaft_rev_s(length_s);
  charge_C_ += 0.5 * length_s * (motor_current_A(shaft_rev_s_) + motor_current_A(shaft));
  shaft_rev_s_ = shaft;
  fins_.settle(length_s);
}

void Vehicle::advance(double to_s) {
  const double begin_s = time_s_;
  const int steps = std::max(1, static_cast<int>(std::ceil((to_s - begin_s) / longest_step_s_ - 1e-6)));
  for (int i = 1; i <= steps; ++i) {
    const double end_s = begin_s + (to_s - begin_s) * i / steps;
    step(end_s - time_s_);
    time_s_ = end_s;
  }
}

Snapshot Vehicle::snapshot() const {
  const Flow flow = flow_of(y_);
  const Vector6 acceleration = inverse_inertia_ * slope(0, y_).tail<6>();
  Snapshot s;
  s.time_s = time_s_;
  s.position_m = y_.head<3>();
  s.world_from_body = Eigen::Quaterniond(y_.segment<4>(3));
  s.velocity_m_s = flow.velocity_m_s;
  s.rate_rad_s = flow.rate_rad_s;
  s.acceleration_m_s2 = acceleration.head<3>() + flow.rate_rad_s.cross(flow.velocity_m_s);
  s.current_m_s = current_m_s(time_s_);
  s.servos_rad = fins_.servos_rad(0);
  s.shaft_rev_s = shaft_rev_s_;
  s.motor_current_A = motor_current_A(shaft_rev_s_);
  s.supply_loss = departures_.sag_per_C * charge_C_;
  return s;
}

double Vehicle::energy_J() const {
  const Flow flow = flow_of(y_);
  const Vector3 P = y_.segment<3>(7), H = y_.segment<3>(10);
  const double lowered = (Eigen::Quaterniond(y_.segment<4>(3)).conjugate() * Vector3::UnitZ()).z();
  return 0.5 * (P.dot(flow.velocity_m_s) + H.dot(flow.rate_rad_s)) -
         hull_.mass_kg * kGravity_m_s2 * hull_.gravity_centre_below_m * lowered;
}

bool Vehicle::finite() const { return y_.allFinite() && y_.tail<6>().norm() < 1e3; }

}  // namespace navcal::reference

// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/layout_vehicle.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "sim/layout/added_mass.h"
#include "sim/layout/rigid_body.h"

namespace navcal::sim {

LayoutVehicle::LayoutVehicle(config::Layout layout)
    : layout_(std::move(layout)), added_mass_(added_mass(layout_)), hull_(layout_) {
  const ActuatorNumbers ballasts_N(std::vector<double>(layout_.ballasts.size()));
  const ActuatorNumbers masses_m(std::vector<double>(layout_.moving_masses.size()));
  at_zero_ = mass_matrix(masses_m);
  restoring_at_zero_ = restoring_of(layout_, ballasts_N, masses_m);
  for (const auto& thruster : layout_.thrusters) thrusters_.emplace_back(thruster, layout_.water_density_kg_m3);
  for (const auto& surface : layout_.surfaces) surfaces_.emplace_back(surface, layout_.water_density_kg_m3);
}

LayoutVehicle::MassMatrix LayoutVehicle::mass_matrix(const ActuatorNumbers& masses_m) const {
  const Matrix6 mass = rigid_body_mass(layout_, masses_m) + added_mass_;
  return {mass, mass.inverse()};
}

LayoutVehicle::Held::Held(const LayoutVehicle& vehicle, const ActuatorValues& at, const Influences& on)
    : moved_(vehicle.layout_.moving_masses.size() > 0 ? std::optional(vehicle.mass_matrix(at.masses_m))
                                                      : std::nullopt),
      mass(moved_ ? moved_->mass : vehicle.at_zero_.mass),
      mass_inverse(moved_ ? moved_->inverse : vehicle.at_zero_.inverse), restoring(vehicle.restoring_at_zero_),
      actuators(at), influences(on) {
  if (moved_ || !vehicle.layout_.ballasts.empty())
    restoring = restoring_of(vehicle.layout_, at.ballasts_N, at.masses_m);
  restoring.net_weight_N -= on.buoyancy_N;
}

Vector6 LayoutVehicle::force(const Vector6& velocity, const Eigen::Vector3d& down, const Held& held) const {
  Vector6 force = hull_(velocity);
  for (std::size_t i = 0; i < surfaces_.size(); ++i)
    surfaces_[i].add(velocity, held.actuators.surfaces_rad[i], force);
  for (std::size_t i = 0; i < thrusters_.size(); ++i)
    thrusters_[i].add(velocity, held.actuators.thrusters[i], held.influences.thrust_factor, force);
  // Halves last: a whole vector that is read after its halves were written waits for them.
  held.restoring.add(down, force);
  const Eigen::Vector3d v = velocity.head<3>(), omega = velocity.tail<3>();
  force[5] -= held.influences.yaw_damping_per_s * held.mass(5, 5) * omega.z();
  const Vector6 momentum = held.mass.lazyProduct(velocity);
  force.head<3>() -= omega.cross(momentum.head<3>());
  force.tail<3>() -= omega.cross(momentum.tail<3>()) + v.cross(momentum.head<3>());
  return force;
}

LayoutVehicle::Change LayoutVehicle::change(const Body& body, const Held& held) const {
  const double cf = std::cos(body.euler_rad[0]), sf = std::sin(body.euler_rad[0]);
  const double ct = std::cos(body.euler_rad[1]), st = std::sin(body.euler_rad[1]);
  const double cp = std::cos(body.euler_rad[2]), sp = std::sin(body.euler_rad[2]);
  const Eigen::Vector3d v = body.velocity.head<3>();
  const Eigen::Vector3d omega = body.velocity.tail<3>();
  Change change;
  change.velocity = held.mass_inverse.lazyProduct(force(body.velocity, {-st, ct * sf, ct * cf}, held));
  // R = Rz(yaw) Ry(pitch) Rx(roll), applied from the right.
  const double y = cf * v.y() - sf * v.z(), z = sf * v.y() + cf * v.z();
  const double x = ct * v.x() + st * z;
  const auto& current_m_s = held.influences.current_m_s;
  change.position_m_s = {cp * x - sp * y + current_m_s[0], sp * x + cp * y + current_m_s[1], ct * z - st * v.x()};
  const double yaw_rate = (sf * omega.y() + cf * omega.z()) / ct;
  change.euler_rad_s = {omega.x() + st * yaw_rate, cf * omega.y() - sf * omega.z(), yaw_rate};
  return change;
}

LayoutVehicle::Step LayoutVehicle::moved_step(const Body& body, const Held& begin, const Held& middle,
                                              const Held& end, double step_s) const {
  const Change k1 = change(body, begin);
  const Change k2 = change(moved(body, k1, step_s / 2), middle);
  const Change k3 = change(moved(body, k2, step_s / 2), middle);
  const Change k4 = change(moved(body, k3, step_s), end);
  const Change mean{(k1.position_m_s + 2 * k2.position_m_s + 2 * k3.position_m_s + k4.position_m_s) / 6,
                    (k1.euler_rad_s + 2 * k2.euler_rad_s + 2 * k3.euler_rad_s + k4.euler_rad_s) / 6,
                    (k1.velocity + 2 * k2.velocity + 2 * k3.velocity + k4.velocity) / 6};
  return {moved(body, mean, step_s), k1.velocity};
}

Body LayoutVehicle::midpoint_step(const Body& body, const ActuatorValues& first_half, const ActuatorValues& all,
                                  double step_s, const Influences& influences) const {
  const Body middle = moved(body, change(body, hold(first_half, influences)), step_s / 2);
  return moved(body, change(middle, hold(all, influences)), step_s);
}

LayoutRun::LayoutRun(const LayoutVehicle& vehicle, const Body& body)
    : LayoutRun(vehicle, body, ActuatorValues::neutral(vehicle.layout())) {}

LayoutRun::LayoutRun(const LayoutVehicle& vehicle, const Body& body, ActuatorValues positions)
    : vehicle_(vehicle), body_(body), positions_(std::move(positions)) {}

void LayoutRun::advance(const ActuatorValues& commands, double seconds) {
  constexpr double kStep_s = 0.01;
  const long steps = std::lround(seconds / kStep_s);
  for (long i = 0; i < steps; ++i) {
    const ActuatorValues next = follow(vehicle_.layout(), positions_, commands, kStep_s);
    body_ = vehicle_.step(body_, mean_of(positions_, next), kStep_s).body;
    positions_ = next;
    time_s_ += kStep_s;
    check_stable(body_, time_s_);
  }
}

}  // namespace navcal::sim

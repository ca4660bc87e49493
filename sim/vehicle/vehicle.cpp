// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/vehicle.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "base/angles.h"
#include "sim/vehicle/mass.h"

namespace navcal::sim {
namespace {

Eigen::Vector3d linear_damping(const config::DampingSettings& damping, const Matrix6& mass, double restoring_Nm) {
  const auto oscillation = [&](double ratio, double inertia) {
    return 2 * ratio * std::sqrt(restoring_Nm / inertia) * inertia;
  };
  return {oscillation(damping.roll_ratio, mass(3, 3)), oscillation(damping.pitch_ratio, mass(4, 4)),
          damping.yaw_per_s * mass(5, 5)};
}

}  // namespace

Vehicle::Vehicle(const config::VehicleSettings& settings)
    : mass_(mass_matrix(settings.hull)), mass_inverse_(mass_.inverse()), hull_(settings.hull, settings.water),
      fins_(settings.fins, settings.water), propeller_(settings.propeller, settings.water),
      restoring_Nm_(settings.hull.mass_kg * kGravity_m_s2 * settings.hull.gravity_below_m),
      damping_Nm_s_(linear_damping(settings.damping, mass_, restoring_Nm_)) {}

Vehicle::Change Vehicle::change(const Body& body, const Controls& held, const Influences& influences) const {
  const double cf = std::cos(body.euler_rad[0]), sf = std::sin(body.euler_rad[0]);
  const double ct = std::cos(body.euler_rad[1]), st = std::sin(body.euler_rad[1]);
  const double cp = std::cos(body.euler_rad[2]), sp = std::sin(body.euler_rad[2]);
  const Eigen::Vector3d v = body.velocity.head<3>();
  const Eigen::Vector3d omega = body.velocity.tail<3>();

  Vector6 force = hull_(body.velocity) + fins_(body.velocity, held.fins_rad);
  const Propeller::Force propeller = propeller_.at(v.x(), held.shaft_rps);
  force[0] += influences.thrust_factor * propeller.thrust_N;
  force[3] += propeller.torque_Nm;
  // Down in body axes is (-st, ct sf, ct cf); the weight acts below the origin, what effects add to buoyancy at
  // it.
  force.head<3>() -= influences.buoyancy_N * Eigen::Vector3d(-st, ct * sf, ct * cf);
  force[3] -= restoring_Nm_ * ct * sf;
  force[4] -= restoring_Nm_ * st;
  force.tail<3>() -= damping_Nm_s_.cwiseProduct(omega);
  force[5] -= influences.yaw_damping_per_s * mass_(5, 5) * omega.z();

  const Vector6 momentum = mass_ * body.velocity;
  force.head<3>() -= omega.cross(momentum.head<3>());
  force.tail<3>() -= omega.cross(momentum.tail<3>()) + v.cross(momentum.head<3>());

  Change change;
  change.velocity = mass_inverse_ * force;
  // R = Rz(yaw) Ry(pitch) Rx(roll), applied from the right.
  const double y = cf * v.y() - sf * v.z(), z = sf * v.y() + cf * v.z();
  const double x = ct * v.x() + st * z;
  change.position_m_s = {cp * x - sp * y + influences.current_m_s[0], sp * x + cp * y + influences.current_m_s[1],
                         ct * z - st * v.x()};
  const double yaw_rate = (sf * omega.y() + cf * omega.z()) / ct;
  change.euler_rad_s = {omega.x() + st * yaw_rate, cf * omega.y() - sf * omega.z(), yaw_rate};
  return change;
}

Vehicle::Step Vehicle::step(const Body& body, const Controls& held, const Influences& influences,
                            double step_s) const {
  const Change k1 = change(body, held, influences);
  const Change k2 = change(moved(body, k1, step_s / 2), held, influences);
  const Change k3 = change(moved(body, k2, step_s / 2), held, influences);
  const Change k4 = change(moved(body, k3, step_s), held, influences);
  const Change mean{(k1.position_m_s + 2 * k2.position_m_s + 2 * k3.position_m_s + k4.position_m_s) / 6,
                    (k1.euler_rad_s + 2 * k2.euler_rad_s + 2 * k3.euler_rad_s + k4.euler_rad_s) / 6,
                    (k1.velocity + 2 * k2.velocity + 2 * k3.velocity + k4.velocity) / 6};
  return {moved(body, mean, step_s), k1.velocity};
}

Body Vehicle::midpoint_step(const Body& body, const Controls& first_half, const Controls& all,
                            const Influences& influences, double step_s) const {
  const Body middle = moved(body, change(body, first_half, influences), step_s / 2);
  return moved(body, change(middle, all, influences), step_s);
}

void check_stable(const Body& body, double time_s) {
  constexpr double kFastest_m_s = 50;
  constexpr double kFastest_rad_s = 50;
  constexpr double kSteepest_rad = 88 / base::kDegreesPerRadian;
  const char* why = nullptr;
  // Written so that NaN fails.
  if (!body.position_m.allFinite() || !(body.velocity.head<3>().norm() < kFastest_m_s) ||
      !(body.velocity.tail<3>().norm() < kFastest_rad_s)) {
    why = "went unstable";
  } else if (!(std::abs(body.euler_rad[1]) < kSteepest_rad)) {
    why = "stands on end, beyond what Euler angles describe,";
  }
  if (why == nullptr) return;
  const auto& v = body.velocity;
  throw UnstableVehicle(fmt::format(
      "the vehicle {} at t = {:.2f} s: roll {:.1f}, pitch {:.1f}, yaw {:.1f} deg, u, v, w = {:.3g}, "
      "{:.3g}, {:.3g} "
      "m/s, p, q, r = {:.3g}, {:.3g}, {:.3g} rad/s, depth {:.2f} m",
      why, time_s, body.euler_rad[0] * base::kDegreesPerRadian, body.euler_rad[1] * base::kDegreesPerRadian,
      body.euler_rad[2] * base::kDegreesPerRadian, v[0], v[1], v[2], v[3], v[4], v[5], body.position_m.z()));
}

}  // namespace navcal::sim

// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/forces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace navcal::reference {
namespace {

constexpr int kStations = 21;
constexpr double kAttackLimit_rad = 0.45;
constexpr double kLeastStream_m_s = 0.001;

Wrench at(const Vector3& place_m, const Vector3& force_N) {
  Wrench wrench;
  wrench << force_N, place_m.cross(force_N);
  return wrench;
}

/// The stations that have width (the outermost two have none): nearly a cylinder with round ends.
struct Stations {
  using Column = Eigen::Array<double, kStations - 2, 1>;
  Column place = Column::LinSpaced(-1 + 2.0 / (kStations - 1), 1 - 2.0 / (kStations - 1));  ///< half lengths
  Column width = (1 - place.square().square().square()).sqrt();                             ///< diameters
};

/// Where the fins point, seen along the hull: fin 1 up, the others clockwise seen from astern; and the way that
/// lift goes at a positive angle.
struct Rig {
  std::array<Vector3, 3> spoke, normal;
  Rig() {
    for (std::size_t i = 0; i < 3; ++i) {
      const double turned = 2 * std::numbers::pi / 3 * static_cast<double>(i);
      spoke[i] = Vector3(0, std::sin(turned), -std::cos(turned));
      normal[i] = Vector3::UnitX().cross(spoke[i]);
    }
  }
};

}  // namespace

Wrench hull_wrench(const Hull& hull, const Flow& flow, double axial_factor, double crossflow_factor) {
  const double u = flow.velocity_m_s.x(), v = flow.velocity_m_s.y(), w = flow.velocity_m_s.z();
  const double q = flow.rate_rad_s.y(), r = flow.rate_rad_s.z();

  static const Stations stations;
  const Stations::Column x = hull.length_m / 2 * stations.place;
  const Stations::Column across = v + x * r, down = w - x * q;
  const Stations::Column weight = stations.width * (across.square() + down.square()).sqrt();
  const double strip = 0.5 * hull.water_density_kg_m3 * hull.crossflow_drag * crossflow_factor * hull.diameter_m *
                       hull.length_m / (kStations - 1);
  Wrench wrench;
  wrench << 0, -strip * (weight * across).sum(), -strip * (weight * down).sum(), 0,
      strip * (weight * down * x).sum(), -strip * (weight * across * x).sum();

  const double frontal_m2 = std::numbers::pi / 4 * hull.diameter_m * hull.diameter_m;
  wrench(0) -= 0.5 * hull.water_density_kg_m3 * hull.axial_drag * axial_factor * frontal_m2 * std::abs(u) * u;

  const double lift = -0.5 * hull.water_density_kg_m3 * hull.lift_area_m2 * hull.lift_slope_per_rad * std::abs(u);
  return wrench + at({hull.lift_station_m, 0, 0}, {0, lift * v, lift * w});
}

Wrench fin_wrench(const Hull& hull, const Flow& flow, const Vector3& fins_rad, double stall_loss) {
  static const Rig rig;
  Wrench sum = Wrench::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 &spoke = rig.spoke[i], &normal = rig.normal[i];
    const Vector3 place = hull.fin_station_m * Vector3::UnitX() + hull.fin_radius_m * spoke;
    const Vector3 stream = flow.velocity_m_s + flow.rate_rad_s.cross(place);
    const double along = stream.x(), against = stream.dot(normal);
    const double attack = std::clamp(
        fins_rad(static_cast<int>(i)) - std::atan2(against, std::max(std::abs(along), kLeastStream_m_s)),
        -kAttackLimit_rad, kAttackLimit_rad);
    const double beyond = std::max(std::abs(attack) - kStall_rad, 0.0);
    const double lifting = attack - std::copysign(stall_loss * beyond, attack);
    const double pressure_N =
        0.5 * hull.water_density_kg_m3 * hull.fin_area_m2 * (along * along + against * against);
    sum += at(place, pressure_N * (hull.fin_lift_slope_per_rad * lifting * normal -
                                   hull.fin_induced_drag * attack * attack * Vector3::UnitX()));
  }
  return sum;
}

Wrench propeller_wrench(const Hull& hull, double surge_m_s, double shaft_rev_s, double thrust_factor,
                        double torque_leak) {
  Wrench wrench = Wrench::Zero();
  if (shaft_rev_s <= 0) return wrench;
  const double d = hull.propeller_diameter_m;
  const double advance = std::max(surge_m_s, 0.0) / (shaft_rev_s * d);
  const double thrust = std::max(hull.thrust_at_rest + hull.thrust_per_advance * advance, 0.0);
  const double scale_N = hull.water_density_kg_m3 * shaft_rev_s * shaft_rev_s * d * d * d * d;
  wrench(0) = scale_N * thrust * thrust_factor;
  wrench(3) = scale_N * d * hull.torque_coefficient * (hull.torque_share + torque_leak);
  return wrench;
}

Wrench static_wrench(const Hull& hull, const Vector3& down, double lift_N) {
  const double weight_N = hull.mass_kg * kGravity_m_s2;
  const Vector3 heavy(0, 0, hull.gravity_centre_below_m);
  Wrench wrench;
  wrench << -lift_N * down, weight_N * heavy.cross(down);
  return wrench;
}

Wrench damping_wrench(const Hull& hull, const Matrix6& inertia, const Vector3& rate_rad_s,
                      double further_yaw_per_s) {
  const double stiffness = hull.mass_kg * kGravity_m_s2 * hull.gravity_centre_below_m;
  // 2 zeta omega I with omega = sqrt(stiffness / I)
  const double roll = 2 * hull.roll_damping_ratio * std::sqrt(stiffness * inertia(3, 3));
  const double pitch = 2 * hull.pitch_damping_ratio * std::sqrt(stiffness * inertia(4, 4));
  const double yaw = (hull.yaw_damping_per_s + further_yaw_per_s) * inertia(5, 5);
  Wrench wrench;
  wrench << 0, 0, 0, -roll * rate_rad_s.x(), -pitch * rate_rad_s.y(), -yaw * rate_rad_s.z();
  return wrench;
}

}  // namespace navcal::reference

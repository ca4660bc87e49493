// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/layout_vehicle.h"

#include <Eigen/LU>
#include <utility>

#include "sim/layout/mass_matrix.h"

namespace navcal::sim {
namespace {

std::optional<Matrix6> unless_zero(const Matrix6& matrix) {
  return matrix.isZero(0) ? std::nullopt : std::optional(matrix);
}

std::optional<Matrix6> beside_diagonal(Matrix6 matrix) {
  matrix.diagonal().setZero();
  return unless_zero(matrix);
}

}  // namespace

Restoring restoring_of(const config::Layout& layout, const ActuatorNumbers& ballasts_N,
                       const ActuatorNumbers& masses_m) {
  const double weight = layout.weight_N();
  Restoring restoring;
  restoring.net_weight_N = weight - layout.body.buoyancy_N;
  restoring.arm_Nm = weight * gravity_centre_m(layout, masses_m) -
                     layout.body.buoyancy_N * vector_of(layout.body.buoyancy_centre_m);
  for (std::size_t i = 0; i < layout.ballasts.size(); ++i) {
    restoring.net_weight_N -= ballasts_N[i];
    restoring.arm_Nm -= ballasts_N[i] * vector_of(layout.ballasts[i].place_m);
  }
  return restoring;
}

Eigen::Vector3d down_of(const Eigen::Vector3d& euler_rad) {
  const double ct = std::cos(euler_rad[1]);
  return {-std::sin(euler_rad[1]), ct * std::sin(euler_rad[0]), ct * std::cos(euler_rad[0])};
}

CrossFlowStrips::CrossFlowStrips(const config::LayoutStrips& strips, double coefficient, double density_kg_m3) {
  for (std::size_t i = 0; i < strips.x_m.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i) % kBlock;
    if (place == 0) blocks_.emplace_back();
    const double per_width = 0.5 * density_kg_m3 * coefficient * strips.length_m[i];
    blocks_.back().x_m[place] = strips.x_m[i];
    blocks_.back().sway_kg_m[place] = per_width * strips.height_m[i];
    blocks_.back().heave_kg_m[place] = per_width * strips.width_m[i];
  }
}

void CrossFlowStrips::add(const Vector6& velocity, Vector6& force) const {
  const double v = velocity[1], w = velocity[2], q = velocity[4], r = velocity[5];
  Strips Y = Strips::Zero(), Z = Strips::Zero(), M = Strips::Zero(), N = Strips::Zero();
  for (const Block& block : blocks_) {
    const Strips vl = v + r * block.x_m;
    const Strips wl = w - q * block.x_m;
    const Strips speed = (vl.square() + wl.square()).sqrt();
    const Strips across = block.sway_kg_m * speed * vl, down = block.heave_kg_m * speed * wl;
    Y += across;
    Z += down;
    N += block.x_m * across;
    M += block.x_m * down;
  }
  force[1] -= Y.sum();
  force[2] -= Z.sum();
  force[4] += M.sum();
  force[5] -= N.sum();
}

Vector6 flow_axes_force(const config::LayoutFlowAxes& flow, const Vector6& velocity) {
  const Eigen::Vector3d linear = velocity.head<3>();
  const double speed = linear.norm();
  const double in_plane = std::hypot(linear.x(), linear.z());
  Vector6 force = Vector6::Zero();
  constexpr double kLeast_m_s = 1e-9;
  if (!(speed > kLeast_m_s)) return force;
  const auto held = [&](double angle) { return std::clamp(angle, -flow.stall_rad, flow.stall_rad); };
  const double alpha = held(std::atan2(linear.z(), linear.x()));
  const double beta = held(std::asin(std::clamp(linear.y() / speed, -1.0, 1.0)));
  const double square = speed * speed;
  const double lift = (flow.lift_kg_m[0] + flow.lift_kg_m[1] * alpha) * square;
  const double drag = (flow.drag_kg_m[0] + flow.drag_kg_m[1] * alpha * alpha) * square;
  force.head<3>() = -drag / speed * linear;
  // Across the velocity, upwards: (w, 0, -u) over its length.
  if (in_plane > kLeast_m_s) force.head<3>() += lift / in_plane * Eigen::Vector3d(linear.z(), 0, -linear.x());
  force[1] -= flow.side_kg_m * beta * square;
  force[3] = flow.roll_kg * beta * square;
  force[4] = (flow.pitch_kg[0] + flow.pitch_kg[1] * alpha) * square;
  force[5] = flow.yaw_kg * beta * square;
  return force;
}

HullDamping::HullDamping(const config::Layout& layout)
    : linear_diagonal_(matrix_of(layout.damping.linear).diagonal()),
      quadratic_diagonal_(matrix_of(layout.damping.quadratic).diagonal()),
      linear_(beside_diagonal(matrix_of(layout.damping.linear))),
      quadratic_(beside_diagonal(matrix_of(layout.damping.quadratic))),
      lift_(unless_zero(matrix_of(layout.damping.lift))),
      axial_kg_m_(0.5 * layout.water_density_kg_m3 * layout.damping.axial_coefficient *
                  layout.damping.axial_area_m2),
      body_lift_kg_m_(0.5 * layout.water_density_kg_m3 * layout.damping.body_lift_area_m2 *
                      layout.damping.body_lift_slope_per_rad),
      body_lift_at_m_(layout.damping.body_lift_at_m),
      strips_(layout.damping.strips, layout.damping.cross_flow_coefficient, layout.water_density_kg_m3),
      flow_axes_(layout.damping.flow_axes) {
  if (layout.damping.factors != config::LayoutDamping{}.factors)
    factors_ = Eigen::Map<const Vector6>(layout.damping.factors.data());
}

Vector6 HullDamping::operator()(const Vector6& velocity) const {
  const double surge = std::abs(velocity[0]);
  const double Y = -body_lift_kg_m_ * surge * velocity[1];
  const double Z = -body_lift_kg_m_ * surge * velocity[2];
  Vector6 force;
  force << -axial_kg_m_ * surge * velocity[0], Y, Z, 0, -body_lift_at_m_ * Z, body_lift_at_m_ * Y;
  force -= (linear_diagonal_ + quadratic_diagonal_.cwiseProduct(velocity.cwiseAbs())).cwiseProduct(velocity);
  if (linear_) force -= *linear_ * velocity;
  if (quadratic_) force -= *quadratic_ * velocity.cwiseAbs().cwiseProduct(velocity);
  if (lift_) force -= surge * (*lift_ * velocity);
  strips_.add(velocity, force);
  if (flow_axes_) force += flow_axes_force(*flow_axes_, velocity);
  if (factors_) force = force.cwiseProduct(*factors_);
  return force;
}

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
    : moved_(vehicle.layout_.moving_masses.empty() ? std::nullopt
                                                   : std::optional(vehicle.mass_matrix(at.masses_m))),
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

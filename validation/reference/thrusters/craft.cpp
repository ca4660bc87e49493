// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/craft.h"

#include <Eigen/LU>
#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
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

namespace {

namespace odeint = boost::numeric::odeint;
constexpr std::size_t kBody = 13;
constexpr double kTetherLength_m = 10;

using ConstVector3 = Eigen::Map<const Vector3>;
ConstVector3 position_of(const std::vector<double>& y) { return ConstVector3(y.data()); }
ConstVector3 linear_momentum_of(const std::vector<double>& y) { return ConstVector3(y.data() + 7); }
ConstVector3 angular_momentum_of(const std::vector<double>& y) { return ConstVector3(y.data() + 10); }
Eigen::Quaterniond attitude_of(const std::vector<double>& y) { return {y[6], y[3], y[4], y[5]}; }

Wrench pull(const Vector3& place_m, const Vector3& force_N) {
  Wrench wrench;
  wrench << force_N, place_m.cross(force_N);
  return wrench;
}

/// The vehicle as its deviations make it.
Plan with_deviations(Plan plan, const CraftDeviations& deviations) {
  plan.mass_kg += deviations.mass_kg;
  plan.gravity_centre_m += deviations.gravity_shift_m;
  plan.buoyancy_N += deviations.lift_N;
  const Vector6 root = (Vector6::Ones() + deviations.added_mass).cwiseMax(0).cwiseSqrt();
  plan.added_mass = root.asDiagonal() * plan.added_mass * root.asDiagonal();
  return plan;
}

Nature with_deviations(Nature nature, const CraftDeviations& deviations) {
  nature.jet_loss += deviations.sway_jet;
  return nature;
}

}  // namespace

struct Craft::Stepper {
  using Pair = odeint::runge_kutta_dopri5<State>;
  explicit Stepper(double tolerance) : stepper(odeint::make_controlled(tolerance, tolerance, Pair())) {}
  odeint::result_of::make_controlled<Pair>::type stepper;
  double step_s = kStep_s;
};

Craft::Craft(const Plan& plan, const CraftDeviations& deviations, const Nature& nature, const Sea& sea,
             const Start& start, double tolerance)
    : plan_(with_deviations(plan, deviations)), deviations_(deviations), sea_(sea), inertia_(inertia(plan_)),
      inverse_inertia_(inertia_.inverse()), displaced_(plan_.added_mass), drag_(plan_, nature.strips),
      drag_factors_(Vector6::Ones() + deviations.damping), y_(kBody + 2 * plan.thrusters.size(), 0.0),
      stepper_(std::make_unique<Stepper>(tolerance)) {
  displaced_.topLeftCorner<3, 3>().diagonal().array() += plan_.buoyancy_N / kGravity_m_s2;
  deviations_.rotors.resize(plan.thrusters.size());
  sea_.add_wave(deviations.wave_m);
  const Nature its_own = with_deviations(nature, deviations);
  for (std::size_t i = 0; i < plan.thrusters.size(); ++i)
    rotors_.emplace_back(plan.thrusters[i], plan.density_kg_m3, deviations_.rotors[i], its_own);
  Vector6 nu;
  nu << start.velocity_m_s, start.rate_rad_s;
  const Eigen::Vector4d q = start.world_from_body.normalized().coeffs();
  const Vector6 h = inertia_ * nu;
  std::copy_n(start.position_m.data(), 3, y_.begin());
  std::copy_n(q.data(), 4, y_.begin() + 3);
  std::copy_n(h.data(), 6, y_.begin() + 7);
}

Craft::~Craft() = default;

void Craft::order(const std::vector<double>& commands) {
  for (std::size_t i = 0; i < rotors_.size() && i < commands.size(); ++i) {
    rotors_[i].settle(time_s_ - settled_s_);
    rotors_[i].order(commands[i]);
  }
  settled_s_ = time_s_;
}

Flow Craft::flow_of(const State& y) const {
  const Vector6 nu = inverse_inertia_ * Eigen::Map<const Vector6>(y.data() + 7);
  return {nu.head<3>(), nu.tail<3>()};
}

double Craft::sag(const State& y) const {
  if (deviations_.sag == 0) return 0;
  double load = 0;
  for (std::size_t i = 0; i < rotors_.size(); ++i) load += Rotor::load(y[kBody + 2 * i]);
  return std::min(deviations_.sag * load / static_cast<double>(rotors_.size()), 0.9);
}

Wrench Craft::still_wrench(const State& y, double time_s, const Flow& flow) const {
  const Vector3 position = position_of(y);
  const Eigen::Quaterniond attitude = attitude_of(y);
  const Vector3 down = attitude.conjugate() * Vector3::UnitZ();
  Wrench sum = drag_(flow, drag_factors_);

  const double gravity = sea_.gravity_m_s2();
  sum += pull(plan_.gravity_centre_m, (plan_.mass_kg * gravity + deviations_.leak_N_s * time_s) * down);
  const double height = plan_.size_m.z();
  const double centre_m =
      position.z() + (attitude * plan_.buoyancy_centre_m).z() + sea_.surface_m(position, time_s);
  const double under = height > 0 ? std::clamp(0.5 + centre_m / height, 0.0, 1.0) : 1;
  sum += pull(plan_.buoyancy_centre_m, -(under * plan_.buoyancy_N * gravity / kGravity_m_s2) * down);

  const Vector3 swell = attitude.conjugate() * sea_.wave_acceleration_m_s2(position, time_s);
  sum += displaced_.leftCols<3>() * swell;
  if (deviations_.tether_kg_m != 0) {
    // The longer the cable, the more of it is dragged.
    const double share = (std::max(position.z(), 0.0) + 5) / kTetherLength_m;
    const Vector3 stern(-plan_.size_m.x() / 2, 0, -plan_.size_m.z() / 2);
    const Vector3 v = flow.velocity_m_s + flow.rate_rad_s.cross(stern);
    sum += pull(stern, -deviations_.tether_kg_m * share * v.norm() * v);
  }
  return sum;
}

Wrench Craft::wrench(const State& y, const State& dy, double time_s, const Flow& flow) const {
  Wrench sum = still_wrench(y, time_s, flow);
  for (std::size_t i = 0; i < rotors_.size(); ++i) {
    const Rotor& rotor = rotors_[i];
    const Vector3 v = flow.velocity_m_s + flow.rate_rad_s.cross(rotor.place_m());
    const double advance = v.dot(rotor.direction());
    const double across = (v - advance * rotor.direction()).norm();
    const std::size_t at = kBody + 2 * i;
    const Push push = rotor.push(y[at], y[at + 1], dy[at], advance, across, time_s);
    sum += pull(rotor.place_m(), push.force_N * rotor.direction());
    sum.tail<3>() += push.moment_Nm * rotor.direction();
  }
  return sum;
}

void Craft::slope(const State& y, State& dy, double time_s) const {
  const Eigen::Quaterniond attitude = attitude_of(y);
  const Flow flow = flow_of(y);
  const Vector3 P = linear_momentum_of(y), H = angular_momentum_of(y), omega = flow.rate_rad_s;
  const double lost = sag(y);
  for (std::size_t i = 0; i < rotors_.size(); ++i) {
    const std::size_t at = kBody + 2 * i;
    const Rotor::Rates rates = rotors_[i].rates(y[at], y[at + 1], time_s - settled_s_, lost);
    dy[at] = rates.speed;
    dy[at + 1] = rates.wake;
  }
  const Wrench tau = wrench(y, dy, time_s, flow);
  const Eigen::Vector2d current = sea_.current_m_s(time_s);
  const Vector3 moved = attitude * flow.velocity_m_s + Vector3(current.x(), current.y(), 0);
  const Eigen::Vector4d turned =
      0.5 * (attitude * Eigen::Quaterniond(0, omega.x(), omega.y(), omega.z())).coeffs();
  const Vector3 force = P.cross(omega) + tau.head<3>();
  const Vector3 moment = H.cross(omega) + P.cross(flow.velocity_m_s) + tau.tail<3>();
  std::copy_n(moved.data(), 3, dy.begin());
  std::copy_n(turned.data(), 4, dy.begin() + 3);
  std::copy_n(force.data(), 3, dy.begin() + 7);
  std::copy_n(moment.data(), 3, dy.begin() + 10);
}

void Craft::step(double to_s) {
  const auto system = [this](const State& y, State& dy, double time_s) { slope(y, dy, time_s); };
  constexpr double kShortest_s = 1e-9;
  stepper_->stepper.reset();  // an order, or the quaternion's new length, may lie between
  while (to_s - time_s_ > kShortest_s) {
    double length_s = std::min(stepper_->step_s, to_s - time_s_);
    const bool is_last = length_s == to_s - time_s_;
    const auto result = stepper_->stepper.try_step(system, y_, time_s_, length_s);
    if (result == odeint::fail || !is_last) stepper_->step_s = length_s;
    if (!(length_s > kShortest_s) || !finite()) break;  // a vehicle without bounds: finite() tells
  }
  time_s_ = to_s;
  Eigen::Map<Eigen::Vector4d>(y_.data() + 3).normalize();
}

void Craft::advance(double to_s) {
  const double begin_s = time_s_;
  const auto steps = std::max<long long>(1, std::llround((to_s - begin_s) / kStep_s));
  for (long long i = 1; i <= steps && finite(); ++i)
    step(begin_s + (to_s - begin_s) * static_cast<double>(i) / static_cast<double>(steps));
  time_s_ = to_s;
}

Snapshot Craft::snapshot() const {
  State dy(y_.size());
  slope(y_, dy, time_s_);
  const Flow flow = flow_of(y_);
  const Vector6 acceleration = inverse_inertia_ * Eigen::Map<const Vector6>(dy.data() + 7);
  Snapshot s;
  s.time_s = time_s_;
  s.position_m = position_of(y_);
  s.world_from_body = attitude_of(y_);
  s.velocity_m_s = flow.velocity_m_s;
  s.rate_rad_s = flow.rate_rad_s;
  s.acceleration_m_s2 = acceleration.head<3>() + flow.rate_rad_s.cross(flow.velocity_m_s);
  s.current_m_s = sea_.current_m_s(time_s_);
  s.supply_loss = sag(y_);
  s.gravity_m_s2 = sea_.gravity_m_s2();
  return s;
}

double Craft::energy_J() const {
  const Flow flow = flow_of(y_);
  const Eigen::Quaterniond attitude = attitude_of(y_);
  const double gravity = sea_.gravity_m_s2();
  const double weight_N = plan_.mass_kg * gravity, lift_N = plan_.buoyancy_N * gravity / kGravity_m_s2;
  const Vector3 arm_Nm = weight_N * plan_.gravity_centre_m - lift_N * plan_.buoyancy_centre_m;
  const double potential_J = -(weight_N - lift_N) * y_[2] - (attitude * arm_Nm).z();
  return 0.5 * (linear_momentum_of(y_).dot(flow.velocity_m_s) + angular_momentum_of(y_).dot(flow.rate_rad_s)) +
         potential_J;
}

Vector6 Craft::momentum() const {
  const Eigen::Quaterniond attitude = attitude_of(y_);
  Vector6 h;
  h << attitude * Vector3(linear_momentum_of(y_)), attitude * Vector3(angular_momentum_of(y_));
  return h;
}

bool Craft::finite() const {
  const auto is_bounded = [](double number) { return std::abs(number) < 1e6; };
  return std::ranges::all_of(y_, is_bounded);
}

}  // namespace navcal::reference::thrusters

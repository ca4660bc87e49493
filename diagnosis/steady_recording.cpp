// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/steady_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <utility>

#include "base/statistics.h"
#include "identify/data/gridded.h"
#include "identify/replay/motion_point.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::diagnosis {

using identify::Channel;
using identify::kGrid_s;
using sim::Vector6;

namespace {

constexpr std::size_t kStretch = 10;  ///< steps of the grid
constexpr double kStretch_s = kStretch * kGrid_s;
constexpr std::size_t kFewestStretches = 5;
/// Thrusters hardly work below this part of the thrust that a tenth of the stretches exceeds.
constexpr double kIdleShare = 0.3;
/// A stretch is apart from the others by so many standard deviations, from the median absolute deviation.
constexpr double kApart_sigma = 4;
/// Least correlation of neighbours, which few of them tell only roughly.
constexpr double kLeastAlike = -0.5;
/// Standard deviations of what is not measured: a tilt, a velocity (a current, where it is over the bottom), a
/// rate.
constexpr double kUnknownTilt_rad = 0.1, kUnknownVelocity_m_s = 0.2, kUnknownRate_rad_s = 0.05;
/// Least standard error of a balance, as part of the weight, and of the weight times half a length.
constexpr double kLeastError = 1e-3;

Vector6 least_errors(const config::Layout& layout) {
  Vector6 least;
  const double weight_N = layout.weight_N();
  least.head<3>().setConstant(kLeastError * weight_N);
  const auto size_m = Eigen::Map<const Eigen::Vector3d>(layout.body.size_m.data());
  least.tail<3>().setConstant(kLeastError * weight_N * size_m.maxCoeff() / 2);
  return least;
}

/// Sum of the sizes of all thrusts at rest, N.
double working_N(const config::Layout& layout, const sim::ActuatorValues& at) {
  double sum_N = 0;
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
    Vector6 force = Vector6::Zero();
    sim::ThrusterForce(layout.thrusters[i], layout.water_density_kg_m3)
        .add(Vector6::Zero(), at.thrusters[i], 1, force);
    sum_N += force.head<3>().norm();
  }
  return sum_N;
}

}  // namespace

SteadyRecording::SteadyRecording(const config::Layout& layout, const CauseLibrary& library,
                                 const identify::RecordedMotion& recording)
    : layout_(layout), library_(library),
      recording_(recording), inputs_{identify::ActuatorInputs(layout_, recording)} {
  const auto missing = inputs_.front().missing();
  if (!missing.empty()) throw std::invalid_argument(recording.name + ": " + missing.front());
  find_stretches();
  leave_out_idle();
  leave_out_apart();
  if (stretches_.size() < kFewestStretches)
    throw std::invalid_argument(fmt::format("{}: {} steady stretches of {:.0f} s; at least {} are needed",
                                            recording.name, stretches_.size(), kStretch_s, kFewestStretches));
  const Balances all = balances(layout_);
  const Vector6 mean = all.rowwise().mean();
  Vector6 scatter = (all.colwise() - mean).rowwise().squaredNorm() / static_cast<double>(all.cols() - 1);
  for (Eigen::Index i = 0; i < 6; ++i) scatter[i] /= effective_number(all.row(i), kLeastAlike);
  Eigen::MatrixXd shared = least_errors(layout_).cwiseAbs2().asDiagonal();
  for (const MotionError& error : unmeasured()) {
    const Vector6 moved = mean_balance(layout_, error) - mean;
    shared += moved * moved.transpose();
  }
  own_covariance_ = shared + Eigen::MatrixXd(scatter.asDiagonal());
  covariance_.compute(own_covariance_);
}

SteadyRecording::SteadyRecording(std::span<const RecordingModel* const> parts, const NominalBalances& nominal)
    : layout_(dynamic_cast<const SteadyRecording&>(*parts.front()).layout_),
      library_(dynamic_cast<const SteadyRecording&>(*parts.front()).library_),
      recording_(parts.front()->recording()), own_covariance_(Eigen::MatrixXd::Zero(6, 6)) {
  const auto count = static_cast<double>(parts.size());
  Balances means(6, std::ssize(parts));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& part = dynamic_cast<const SteadyRecording&>(*parts[i]);
    inputs_.push_back(part.inputs_.front());
    for (const Stretch& stretch : part.stretches_) {
      stretches_.push_back(stretch);
      stretches_.back().inputs = i;
    }
    // An error of what is not measured may be the same in all of them.
    own_covariance_ += part.own_covariance_ / count;
    means.col(static_cast<Eigen::Index>(i)) = part.balance();
  }
  const Balances apart = means.colwise() - means.rowwise().mean().eval();
  const double squares = apart.cwiseProduct(nominal.scatter.llt().solve(apart)).sum();
  const double apartness = std::min(squares / std::max(6 * (count - 1), 1.0), 1.0);
  compare_with(nominal, 1 - apartness + apartness / count);
}

void SteadyRecording::compare_with(const NominalBalances& nominal, double scattered) {
  nominal_ = nominal.mean;
  const Eigen::VectorXd beyond = (own_covariance_.diagonal() - nominal.errors).cwiseMax(0);
  covariance_.compute((scattered + 1 / nominal.effective) * nominal.scatter +
                      Eigen::MatrixXd(beyond.asDiagonal()));
  freedom_ = nominal.freedom();
}

Eigen::MatrixXd SteadyRecording::usual_scatter() const {
  const Eigen::VectorXd start = values_at(Eigen::VectorXd::Zero(library_.columns()));
  const Vector6 here = balance();
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(6, 6);
  for (const Cause& cause : library_.causes) {
    for (const CauseParameter& parameter : cause.parameters) {
      if (parameter.is_one_sided()) continue;
      const Vector6 moved =
          slope(start, here, parameter.column) * kUsualTolerance * parameter.typical * parameter.per_unit;
      scatter += moved * moved.transpose();
    }
  }
  return scatter;
}

void SteadyRecording::find_stretches() {
  const identify::GriddedMotion grid(recording_, Channel::water_x);
  const Channel depth = recording_.has(Channel::gauge_depth) ? Channel::gauge_depth : Channel::depth;
  for (std::size_t k = 0; k + kStretch < grid.rows; k += kStretch) {
    Stretch stretch{.begin_s = kGrid_s * static_cast<double>(k), .points = {}};
    for (std::size_t i = k; i <= k + kStretch; ++i) {
      sim::Body point;
      point.position_m = {0, 0, 10};  // away from the surface
      point.euler_rad = grid.euler(i);
      const Eigen::Vector3d sinking(0, 0, recording_.has(depth) ? grid.slope(depth, i) : 0);
      point.velocity << (grid.has_velocity
                             ? grid.velocity[i]
                             : Eigen::Vector3d(identify::world_from_body(point.euler_rad).transpose() * sinking)),
          grid.rates[i];
      if (!point.velocity.allFinite() || !point.euler_rad.allFinite()) break;
      stretch.points.push_back(point);
    }
    if (stretch.points.size() == kStretch + 1) stretches_.push_back(std::move(stretch));
  }
}

std::vector<MotionError> SteadyRecording::unmeasured() const {
  constexpr std::array kAngles{Channel::roll, Channel::pitch, Channel::heading};
  constexpr std::array kRates{Channel::rate_x, Channel::rate_y, Channel::rate_z};
  std::vector<MotionError> all;
  const auto has = [&](Channel channel) { return recording_.has(channel); };
  const bool has_sinking = has(Channel::depth) || has(Channel::gauge_depth) || has(Channel::bottom_z);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (k < 2 && !has(kAngles[k])) all.push_back({kUnknownTilt_rad * Eigen::Vector3d::Unit(i), Vector6::Zero()});
    if (!has(Channel::water_x) && (k < 2 || !has_sinking))
      all.push_back({Eigen::Vector3d::Zero(), kUnknownVelocity_m_s * Vector6::Unit(i)});
    if (!has(kRates[k]) && !has(kAngles[k]))
      all.push_back({Eigen::Vector3d::Zero(), kUnknownRate_rad_s * Vector6::Unit(3 + i)});
  }
  return all;
}

void SteadyRecording::leave_out(const std::vector<bool>& of_stretches) {
  std::vector<Stretch> kept;
  for (std::size_t i = 0; i < of_stretches.size(); ++i)
    if (!of_stretches[i]) kept.push_back(std::move(stretches_[i]));
  stretches_ = std::move(kept);
}

void SteadyRecording::leave_out_idle() {
  if (layout_.thrusters.empty() || stretches_.empty()) return;
  const identify::ActuatorTrajectory actuators = inputs_.front().trajectory(layout_);
  sim::ActuatorValues at = sim::ActuatorValues::neutral(layout_);
  std::vector<double> working;
  for (const Stretch& stretch : stretches_) {
    actuators.mean(stretch.begin_s, kStretch_s, at);
    working.push_back(working_N(layout_, at));
  }
  std::vector<double> sorted = working;
  std::sort(sorted.begin(), sorted.end());
  const double least_N = kIdleShare * sorted[sorted.size() * 9 / 10];
  std::vector<bool> is_idle(working.size());
  for (std::size_t i = 0; i < working.size(); ++i) is_idle[i] = working[i] < least_N;
  leave_out(is_idle);
}

void SteadyRecording::leave_out_apart() {
  const Balances all = balances(layout_);
  std::vector<bool> is_apart(stretches_.size());
  const Vector6 least = least_errors(layout_);
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    std::vector<double> values(all.row(axis).begin(), all.row(axis).end());
    const double middle = base::median(values);
    for (double& value : values) value = std::abs(value - middle);
    const double sigma = std::hypot(1.4826 * base::median(values), least[axis]);
    for (std::size_t i = 0; i < values.size(); ++i) is_apart[i] = is_apart[i] || values[i] > kApart_sigma * sigma;
  }
  leave_out(is_apart);
}

Eigen::VectorXd SteadyRecording::values_at(const Eigen::VectorXd& at) const {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(library_.columns());
  start.head(std::ssize(library_.parameters)) = identify::prior_values(library_.parameters);
  return values_within(library_, start, at);
}

config::Layout SteadyRecording::layout_with(const Eigen::VectorXd& values) const {
  Eigen::VectorXd others = values.head(std::ssize(library_.parameters));
  std::vector<double> factors(layout_.thrusters.size(), 1);
  for (const Cause& cause : library_.causes) {
    if (cause.name != "thrust_scale") continue;
    double& scale = others[cause.parameters.front().column];
    factors[std::stoul(cause.of.substr(cause.of.find('.') + 1)) - 1] += std::exchange(scale, 0);
  }
  config::Layout changed = identify::with_values(layout_, library_.parameters, others);
  for (std::size_t i = 0; i < factors.size(); ++i) changed.thrusters[i].force_scale *= factors[i];
  return changed;
}

SteadyRecording::Balances SteadyRecording::balances(const config::Layout& layout, const MotionError& error) const {
  const sim::LayoutVehicle vehicle(layout);
  std::vector<identify::ActuatorTrajectory> actuators;
  for (const identify::ActuatorInputs& inputs : inputs_) actuators.push_back(inputs.trajectory(layout));
  sim::ActuatorValues at = sim::ActuatorValues::neutral(layout);
  Balances all(6, std::ssize(stretches_));
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    const Stretch& stretch = stretches_[s];
    Vector6 force = Vector6::Zero();
    for (std::size_t k = 0; k < kStretch; ++k) {
      const sim::Body& point = stretch.points[k];
      actuators[stretch.inputs].mean(stretch.begin_s + kGrid_s * static_cast<double>(k), kGrid_s, at);
      force += vehicle.force(point.velocity + error.velocity, sim::down_of(point.euler_rad + error.euler_rad),
                             vehicle.hold(at)) /
               kStretch;
    }
    const Vector6 change = stretch.points.back().velocity - stretch.points.front().velocity;
    all.col(static_cast<Eigen::Index>(s)) = force - vehicle.mass() * change / kStretch_s;
  }
  return all;
}

Vector6 SteadyRecording::slope(const Eigen::VectorXd& at, const Vector6& here, Eigen::Index column) const {
  const identify::Parameter& parameter = library_.parameters[static_cast<std::size_t>(column)];
  double step = parameter.step > 0 ? parameter.step : kEffectStep * parameter.prior_std;
  if (at[column] + step > parameter.high) step = -step;
  Eigen::VectorXd moved = at;
  moved[column] += step;
  return (mean_balance(layout_with(moved)) - here) / step;
}

std::optional<RecordingFit> SteadyRecording::fit(const Eigen::VectorXd& at) const {
  const Eigen::VectorXd values = values_at(at);
  Eigen::MatrixXd white = Eigen::MatrixXd::Zero(6, values.size() + 1);
  const Vector6 here = mean_balance(layout_with(values));
  white.rightCols<1>() = here - nominal_;
  for (const Cause& cause : library_.causes)
    for (const Eigen::Index column : cause.columns()) white.col(column) = slope(values, here, column);
  covariance_.matrixL().solveInPlace(white);
  const auto jacobian = white.leftCols(values.size());
  const Vector6 residual = white.rightCols<1>();
  const Likelihood linear{jacobian.transpose() * jacobian, -jacobian.transpose() * residual,
                          -residual.squaredNorm() / 2, 0, freedom_};
  const Eigen::VectorXd inside = within(at);
  return RecordingFit{linear.about(-inside), inside};
}

std::optional<RecordingPower> SteadyRecording::power(const Eigen::VectorXd& at) const {
  constexpr std::array kBalances{"surge force", "sway force",   "heave force",
                                 "roll moment", "pitch moment", "yaw moment"};
  const Balances apart = balances(layout_with(values_at(at))).colwise() - nominal_;
  const Eigen::MatrixXd white = covariance_.matrixL().solve(apart);
  const Vector6 mean = white.rowwise().mean();
  RecordingPower power;
  power.mean_square = mean.squaredNorm() / 6;
  power.of_channel.fill(-1);
  for (Eigen::Index s = 0; s < white.cols(); ++s) {
    power.of_block.push_back(mean.dot(white.col(s)));
    power.readings.push_back(6);
  }
  const Vector6 sigma = covariance_.reconstructedMatrix().diagonal().cwiseSqrt();
  const boost::math::students_t_distribution<> chance(freedom_);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double size = std::abs(apart.row(i).mean());
    const double p_value = 6 * 2 * boost::math::cdf(boost::math::complement(chance, size / sigma[i]));
    if (p_value < kNominalChance)
      power.apart.push_back({kBalances[static_cast<std::size_t>(i)], "whole recording", size, sigma[i],
                             i < 3 ? "N" : "Nm", p_value});
  }
  std::ranges::sort(power.apart, {}, &gap::WhereEntry::p_value);
  return power;
}

}  // namespace navcal::diagnosis

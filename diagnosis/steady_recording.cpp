// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/steady_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "base/statistics.h"
#include "diagnosis/limits.h"
#include "identify/data/gridded.h"
#include "identify/replay/replayed_motion.h"
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
/// Stretches that follow each other are not independent: their number counts by this factor.
constexpr double kIndependentShare = 0.5;
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
    : layout_(layout), library_(library), recording_(recording), inputs_(layout_, recording) {
  if (!inputs_.missing().empty()) throw std::invalid_argument(recording.name + ": " + inputs_.missing().front());
  find_stretches();
  leave_out_idle();
  leave_out_apart();
  if (stretches_.size() < kFewestStretches)
    throw std::invalid_argument(fmt::format("{}: {} steady stretches of {:.0f} s; at least {} are needed",
                                            recording.name, stretches_.size(), kStretch_s, kFewestStretches));
  const Balances all = balances(layout_);
  const auto count = static_cast<double>(all.cols());
  const Vector6 mean = all.rowwise().mean();
  const Vector6 scatter = (all.colwise() - mean).rowwise().squaredNorm() / (count - 1);
  Eigen::MatrixXd shared = least_errors(layout_).cwiseAbs2().asDiagonal();
  for (const MotionError& error : unmeasured()) {
    const Vector6 moved = mean_balance(layout_, error) - mean;
    shared += moved * moved.transpose();
  }
  covariance_.compute(shared + Eigen::MatrixXd((scatter / (kIndependentShare * count)).asDiagonal()));
}

void SteadyRecording::find_stretches() {
  const identify::GriddedMotion grid(recording_, Channel::water_x);
  const Channel depth = recording_.has(Channel::gauge_depth) ? Channel::gauge_depth : Channel::depth;
  for (std::size_t k = 0; k + kStretch < grid.rows; k += kStretch) {
    Stretch stretch{kGrid_s * static_cast<double>(k), {}};
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
  std::vector<MotionError> all;
  const auto has = [&](Channel channel) { return recording_.has(channel); };
  const std::array tilts{Channel::roll, Channel::pitch};
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    if (has(tilts[i])) continue;
    all.emplace_back();
    all.back().euler_rad[static_cast<Eigen::Index>(i)] = kUnknownTilt_rad;
  }
  const bool has_sinking = has(Channel::depth) || has(Channel::gauge_depth) || has(Channel::bottom_z);
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (has(Channel::water_x) || (i == 2 && has_sinking)) continue;
    all.emplace_back();
    all.back().velocity[i] = kUnknownVelocity_m_s;
  }
  const std::array rates{Channel::rate_x, Channel::rate_y, Channel::rate_z};
  const std::array angles{Channel::roll, Channel::pitch, Channel::heading};
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (has(rates[i]) || has(angles[i])) continue;
    all.emplace_back();
    all.back().velocity[3 + static_cast<Eigen::Index>(i)] = kUnknownRate_rad_s;
  }
  return all;
}

void SteadyRecording::leave_out_idle() {
  if (layout_.thrusters.empty()) return;
  const identify::ActuatorTrajectory actuators = inputs_.trajectory(layout_);
  sim::ActuatorValues at = sim::ActuatorValues::neutral(layout_);
  std::vector<double> working;
  for (const Stretch& stretch : stretches_) {
    actuators.mean(stretch.begin_s, kStretch_s, at);
    working.push_back(working_N(layout_, at));
  }
  std::vector<double> sorted = working;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty()) return;
  const double least_N = kIdleShare * sorted[sorted.size() * 9 / 10];
  std::erase_if(stretches_, [&, i = std::size_t{0}](const Stretch&) mutable { return working[i++] < least_N; });
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
  std::erase_if(stretches_, [&, i = std::size_t{0}](const Stretch&) mutable { return is_apart[i++]; });
}

Eigen::VectorXd SteadyRecording::values_at(const Eigen::VectorXd& at) const {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(library_.columns());
  start.head(std::ssize(library_.parameters)) = identify::prior_values(library_.parameters);
  return values_within(library_, start, at);
}

config::Layout SteadyRecording::layout_with(const Eigen::VectorXd& values) const {
  return identify::with_values(layout_, library_.parameters, values.head(std::ssize(library_.parameters)));
}

SteadyRecording::Balances SteadyRecording::balances(const config::Layout& layout, const MotionError& error) const {
  const sim::LayoutVehicle vehicle(layout);
  const identify::ActuatorTrajectory actuators = inputs_.trajectory(layout);
  sim::ActuatorValues at = sim::ActuatorValues::neutral(layout);
  Balances all(6, std::ssize(stretches_));
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    const Stretch& stretch = stretches_[s];
    Vector6 force = Vector6::Zero();
    for (std::size_t k = 0; k < kStretch; ++k) {
      const sim::Body& point = stretch.points[k];
      actuators.mean(stretch.begin_s + kGrid_s * static_cast<double>(k), kGrid_s, at);
      force += vehicle.force(point.velocity + error.velocity, sim::down_of(point.euler_rad + error.euler_rad),
                             vehicle.hold(at)) /
               kStretch;
    }
    const Vector6 change = stretch.points.back().velocity - stretch.points.front().velocity;
    all.col(static_cast<Eigen::Index>(s)) = force - vehicle.mass() * change / kStretch_s;
  }
  return all;
}

std::optional<RecordingFit> SteadyRecording::fit(const Eigen::VectorXd& at) const {
  const Eigen::VectorXd values = values_at(at);
  const Vector6 here = mean_balance(layout_with(values));
  Eigen::MatrixXd white = Eigen::MatrixXd::Zero(6, values.size() + 1);
  white.rightCols<1>() = here;
  for (std::size_t i = 0; i < library_.parameters.size(); ++i) {
    const identify::Parameter& parameter = library_.parameters[i];
    const auto column = static_cast<Eigen::Index>(i);
    double step = parameter.step > 0 ? parameter.step : kEffectStep * parameter.prior_std;
    if (values[column] + step > parameter.high) step = -step;
    Eigen::VectorXd moved = values;
    moved[column] += step;
    white.col(column) = (mean_balance(layout_with(moved)) - here) / step;
  }
  covariance_.matrixL().solveInPlace(white);
  const auto jacobian = white.leftCols(values.size());
  const Vector6 residual = white.rightCols<1>();
  const double log_det = 2 * covariance_.matrixLLT().diagonal().array().log().sum();
  const Likelihood linear{jacobian.transpose() * jacobian, -jacobian.transpose() * residual,
                          -(residual.squaredNorm() + log_det) / 2};
  const Eigen::VectorXd inside = values - values_at(Eigen::VectorXd::Zero(at.size()));
  return RecordingFit{linear.about(-inside), inside};
}

std::optional<RecordingPower> SteadyRecording::power(const Eigen::VectorXd& at) const {
  const Eigen::MatrixXd white = covariance_.matrixL().solve(balances(layout_with(values_at(at))));
  const Vector6 mean = white.rowwise().mean();
  RecordingPower power;
  power.mean_square = mean.squaredNorm() / 6;
  power.of_channel.fill(-1);
  for (Eigen::Index s = 0; s < white.cols(); ++s) {
    power.of_block.push_back(mean.dot(white.col(s)));
    power.readings.push_back(6);
  }
  return power;
}

CauseLibrary steady_causes_of(const config::Layout& layout, const identify::RecordedMotion& recording,
                              std::span<const std::string> excluded) {
  constexpr std::array<std::string_view, 8> kUntold{"added_mass",      "fin_dead_band", "fin_lag",
                                                    "fin_offset",      "thruster_lag",  "thruster_dead_band",
                                                    "thruster_offset", "yaw_damping"};
  CauseLibrary library = causes_of(layout, recording, excluded);
  std::erase_if(library.causes, [&](const Cause& cause) {
    return cause.is_instrument || std::find(kUntold.begin(), kUntold.end(), cause.name) != kUntold.end();
  });
  return library;
}

Leads SteadySource::leads(std::size_t nominals) const {
  // Student's t in place of the normal distribution, where they leave 5 %.
  const double freedom = static_cast<double>(std::max<std::size_t>(nominals, 2) - 1);
  const double t = boost::math::quantile(boost::math::students_t_distribution<>(freedom), 0.975);
  return {kSteadyGap_nats, kSteadyNamed_nats, t / 1.96};
}

}  // namespace navcal::diagnosis

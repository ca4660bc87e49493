#include "calib/turn_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace navcal::calib {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;
/// How a scale or a deviation not yet known enters the weights: a gyro or compass is hardly worse than this.
constexpr double kLikelyError = 0.1;

/// Estimate as far as it is known, for weights.
double shrunk(double departure, double variance) {
  return departure * kLikelyError * kLikelyError / (kLikelyError * kLikelyError + variance);
}

constexpr int kConstants[] = {kScale, kB, kC, kD, kE};

double wrapped(double angle_rad) { return std::remainder(angle_rad, kTurn_rad); }

Eigen::Vector4d harmonics(double heading_rad) {
  return {std::sin(heading_rad), std::cos(heading_rad), std::sin(2 * heading_rad), std::cos(2 * heading_rad)};
}

}  // namespace

TurnFilter::TurnFilter(const Parameters& parameters, const TurnPrior& prior)
    : parameters_(parameters), prior_(prior) {
  ConstantsMatrix covariance;
  Constants with_bias;
  for (int i = 0; i < 5; ++i) {
    with_bias[i] = prior.covariance(kConstants[i], kBias);
    for (int j = 0; j < 5; ++j) covariance(i, j) = prior.covariance(kConstants[i], kConstants[j]);
    // Held: no regressor will touch it, and what stands here only keeps the matrix regular.
    if (covariance(i, i) == 0) covariance(i, i) = 1;
  }
  prior_information_ = covariance.inverse();
  information_ = prior_information_;
  sensitivity_.row(1) = prior_information_ * with_bias;
  state_[1] = prior.mean[kBias];
  state_covariance_(1, 1) =
      std::max(prior.covariance(kBias, kBias) - with_bias.dot(prior_information_ * with_bias), 0.0);
  solve();
}

bool TurnFilter::held(int coefficient) const { return prior_.covariance(coefficient, coefficient) == 0; }

TurnFilter::Constants TurnFilter::deviation_regressors(double heading_rad) const {
  Constants all;
  all << 0, harmonics(heading_rad);
  for (int i = 1; i < 5; ++i) {
    if (held(kConstants[i])) all[i] = 0;
  }
  return all;
}

double TurnFilter::heading_variance(double measured_rad) const {
  // psi = psi_m - E(psi_m): the noise of psi_m counts by 1 - E'.
  const Constants slope{0, std::cos(measured_rad), -std::sin(measured_rad), 2 * std::cos(2 * measured_rad),
                        -2 * std::sin(2 * measured_rad)};
  double factor = 1;
  for (int i = 1; i < 5; ++i) {
    factor -= slope[i] * (prior_.mean[kConstants[i]] + shrunk(solution_.departure[i], solution_.covariance(i, i)));
  }
  const double deviation = parameters_.heading_noise_rad * std::clamp(factor, 0.5, 2.0);
  return deviation * deviation;
}

void TurnFilter::update(const TurnStep& step) {
  const Eigen::Vector<double, 7> all{
      step.time_s,      step.heading_rad,   step.duration_s, step.measured_angle_rad, step.measured_angle_b_rad,
      step.bias_time_s, step.tilt_angle_rad};
  const bool begins = step.begins_segment || !in_segment_;
  if (!all.allFinite() || (!begins && step.duration_s <= 0)) {
    ++left_out_;
    in_segment_ = false;
    return;
  }
  if (begins) {
    start(step);
  } else {
    predict(step);
    correct(step.heading_rad);
    solve();
  }
  in_segment_ = true;
  time_s_ = step.time_s;
  ++readings_;
}

double TurnFilter::without_deviation(double measured_rad) const {
  return measured_rad - prior_.mean.tail<4>().dot(harmonics(measured_rad));
}

void TurnFilter::start(const TurnStep& step) {
  const double pause_s = readings_ > 0 ? std::max(step.time_s - time_s_, 0.0) : 0;
  state_covariance_(1, 1) += parameters_.bias_walk_rad_s_sqrt_s * parameters_.bias_walk_rad_s_sqrt_s * pause_s;
  state_[0] = wrapped(without_deviation(step.heading_rad));
  sensitivity_.row(0) = -deviation_regressors(step.heading_rad);
  state_covariance_(0, 0) = heading_variance(step.heading_rad);
  state_covariance_(0, 1) = state_covariance_(1, 0) = 0;
  pull_state_(0, 0) = pull_state_(0, 1) = pull_state_(1, 0) = 0;
}

void TurnFilter::predict(const TurnStep& step) {
  Eigen::Matrix2d transition;
  transition << 1, step.bias_time_s, 0, 1;
  state_ = transition * state_;
  state_[0] = wrapped(state_[0] + prior_.mean[kScale] * step.measured_angle_rad + step.tilt_angle_rad);
  sensitivity_ = transition * sensitivity_;
  if (!held(kScale)) sensitivity_(0, 0) += step.measured_angle_rad;

  // White noise of the rate through F, which is bias_time / duration.
  const double angle_noise = parameters_.rate_noise_rad_sqrt_s * step.bias_time_s;
  const double angle_variance = angle_noise * angle_noise / step.duration_s;
  const double scale = prior_.mean[kScale] + shrunk(solution_.departure[0], solution_.covariance(0, 0));
  const double walk = parameters_.bias_walk_rad_s_sqrt_s;
  state_covariance_ = transition * state_covariance_ * transition.transpose();
  state_covariance_(0, 0) += scale * scale * angle_variance;
  state_covariance_(1, 1) += walk * walk * step.duration_s;
  pull_state_ = transition * pull_state_ * transition.transpose();
  pull_state_(0, 0) += angle_variance;
}

void TurnFilter::correct(double measured_rad) {
  const Constants gradient = deviation_regressors(measured_rad) + sensitivity_.row(0).transpose();
  const double expected = gradient.dot(solution_.departure);
  // The turn since the last reading is known far better than half a turn once anything is known.
  const double innovation = wrapped(without_deviation(measured_rad) - state_[0] - expected) + expected;
  const double variance_of_reading = heading_variance(measured_rad);
  const double variance = state_covariance_(0, 0) + variance_of_reading;

  information_ += gradient * gradient.transpose() / variance;
  moment_ += gradient * (innovation / variance);
  square_ += innovation * innovation / variance;
  pull_ += pull_state_(0, 0) / variance;
  ++innovations_;

  const Eigen::Vector2d gain = state_covariance_.col(0) / variance;
  Eigen::Matrix2d keep = Eigen::Matrix2d::Identity();
  keep.col(0) -= gain;
  state_ += gain * innovation;
  sensitivity_ -= gain * gradient.transpose();
  state_covariance_ = keep * state_covariance_ * keep.transpose() + gain * gain.transpose() * variance_of_reading;
  pull_state_ = keep * pull_state_ * keep.transpose();
}

void TurnFilter::solve() {
  ConstantsMatrix covariance = information_.ldlt().solve(ConstantsMatrix::Identity());
  Constants departure = covariance * moment_;
  const double chi_squared =
      square_ - 2 * moment_.dot(departure) + departure.dot((information_ - prior_information_) * departure);
  solution_.chi_squared = std::max(chi_squared, 0.0);

  if (!held(kScale)) {
    const Constants along = covariance.col(0);  // how all move when the scale does
    const double prior_information = 1 / prior_.covariance(kScale, kScale);
    const double learnt = 1 / along[0] - prior_information;
    const double pull = pull_ * reduced_chi_squared();
    if (learnt > 2 * pull) {
      const double enlarged = pull / (1 - pull * along[0]);
      departure += along * (enlarged * (prior_.mean[kScale] + departure[0]));
      covariance += along * along.transpose() * enlarged;
      // The noise in the score is that of the information before the subtraction.
      const Constants corrected = covariance.col(0);
      covariance += corrected * corrected.transpose() * pull;
    } else {
      // The turns seen are no more than noise: the scale stays as believed before.
      departure -= along * (departure[0] / along[0]);
      covariance += along * along.transpose() * (learnt / (prior_information * along[0]));
    }
  }
  solution_.departure = departure;
  solution_.covariance = covariance;
}

double TurnFilter::reduced_chi_squared() const {
  const auto sought = static_cast<std::uint64_t>(std::count(prior_.sought.begin(), prior_.sought.end(), true));
  return innovations_ > sought ? solution_.chi_squared / static_cast<double>(innovations_ - sought) : 1;
}

TurnCoefficients TurnFilter::estimate() const {
  TurnCoefficients all = prior_.mean;
  for (int i = 0; i < 5; ++i) all[kConstants[i]] += solution_.departure[i];
  all[kBias] = state_[1] + sensitivity_.row(1).dot(solution_.departure);
  return all;
}

TurnCovariance TurnFilter::unscaled_covariance() const {
  TurnCovariance all;
  const Eigen::Matrix<double, 1, 5> with_bias = sensitivity_.row(1) * solution_.covariance;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) all(kConstants[i], kConstants[j]) = solution_.covariance(i, j);
    all(kBias, kConstants[i]) = all(kConstants[i], kBias) = with_bias[i];
  }
  all(kBias, kBias) = state_covariance_(1, 1) + with_bias.dot(sensitivity_.row(1));
  for (int i : kConstants) {
    if (!held(i)) continue;
    all.row(i).setZero();
    all.col(i).setZero();
  }
  return all;
}

TurnCovariance TurnFilter::covariance() const {
  return unscaled_covariance() * std::max(reduced_chi_squared(), 1.0);
}

double TurnFilter::condition() const {
  // At most six: no allocation.
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  const TurnCovariance all = unscaled_covariance();
  int chosen[6] = {};
  int count = 0;
  for (int i = 0; i < 6; ++i) {
    if (prior_.sought[static_cast<std::size_t>(i)]) chosen[count++] = i;
  }
  if (count == 0) return 1;
  Matrix information(count, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) information(i, j) = all(chosen[i], chosen[j]);
  }
  information = Matrix(information.inverse());
  for (int i = 0; i < count; ++i) {
    const double believed = 1 / prior_.covariance(chosen[i], chosen[i]);
    information(i, i) -= believed;
    // Less than was believed before, but for rounding.
    if (!(information(i, i) > 1e-6 * believed)) return std::numeric_limits<double>::infinity();
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> unit = information.diagonal().cwiseSqrt().cwiseInverse();
  information = Matrix(unit.asDiagonal() * information * unit.asDiagonal());
  const auto eigenvalues =
      Eigen::SelfAdjointEigenSolver<Matrix>(information, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(eigenvalues[0] > 0)) return std::numeric_limits<double>::infinity();
  return eigenvalues[count - 1] / eigenvalues[0];
}

double TurnFilter::heading_rad() const {
  return wrapped(state_[0] + sensitivity_.row(0).dot(solution_.departure));
}

double TurnFilter::heading_variance_rad2() const {
  return state_covariance_(0, 0) + sensitivity_.row(0).dot(solution_.covariance * sensitivity_.row(0).transpose());
}

void TurnFilter::archive(Archive& archive) {
  archive.tag("turn_filter 1");
  archive(prior_.mean, prior_.covariance, prior_.sought, prior_information_);
  archive(state_, state_covariance_, sensitivity_, pull_state_, information_, moment_, square_, pull_, solution_,
          time_s_, in_segment_, readings_, innovations_, left_out_);
}

}  // namespace navcal::calib

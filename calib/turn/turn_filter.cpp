// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/turn_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/symmetric_solve.h"

namespace navcal::calib {
namespace {

/// Far beyond any scale, bias (rad/s) or deviation (rad), and still no limit to the accuracy of doubles.
constexpr double kUnknownTurnStd = 10;

/// Scales and biases (rad/s) are hardly more wrong than this; for weights and unwrapping only.
constexpr double kLikelyError = 0.05;

/// A departure as far as it is known.
double shrunk(double departure, double variance) {
  return departure * kLikelyError * kLikelyError / (kLikelyError * kLikelyError + variance);
}

constexpr int kConstants[] = {kScale, kB, kC, kD, kE};

/// Fewer do not tell how large the noise is.
constexpr std::uint64_t kEnoughInnovations = 50;

}  // namespace

TurnPrior TurnPrior::unknown_gyro() {
  TurnPrior prior;
  for (int i : {kScale, kBias}) {
    prior.covariance(i, i) = kUnknownTurnStd * kUnknownTurnStd;
    prior.sought[static_cast<std::size_t>(i)] = true;
  }
  return prior;
}

TurnPrior TurnPrior::unknown_compass(double scale, double bias_rad_s, const Eigen::Matrix2d& gyro_covariance) {
  TurnPrior prior = unknown_both();
  prior.mean[kScale] = scale;
  prior.mean[kBias] = bias_rad_s;
  prior.covariance.topLeftCorner<2, 2>() = gyro_covariance;
  prior.sought[kScale] = prior.sought[kBias] = false;
  return prior;
}

TurnPrior TurnPrior::unknown_both() {
  TurnPrior prior;
  prior.covariance.diagonal().setConstant(kUnknownTurnStd * kUnknownTurnStd);
  prior.sought.fill(true);
  return prior;
}

void TurnNoise::start(const Row& direction, double variance) {
  heading_ = variance * direction * direction.transpose();
  heading_bias_.setZero();
}

void TurnNoise::predict(double bias_time_s, const Row& direction, double variance) {
  heading_ += bias_time_s * (heading_bias_ + heading_bias_.transpose()) + bias_time_s * bias_time_s * bias_ +
              variance * direction * direction.transpose();
  heading_bias_ += bias_time_s * bias_;
}

void TurnNoise::correct(const Row& direction, double variance, double innovation_variance,
                        const Eigen::Vector2d& gain) {
  const Products of_reading = variance * direction * direction.transpose();
  const Products of_row = heading_ + of_reading;
  expected_ += of_row / innovation_variance;
  // The rows of heading and bias each lose gain times the innovation's row.
  const Products mixed = heading_bias_ + heading_bias_.transpose();
  bias_ += gain[1] * gain[1] * of_row - gain[1] * mixed;
  heading_bias_ = (1 - gain[0]) * (heading_bias_ - gain[1] * heading_) + gain[0] * gain[1] * of_reading;
  heading_ = (1 - gain[0]) * (1 - gain[0]) * heading_ + gain[0] * gain[0] * of_reading;
}

TurnFilter::TurnFilter(const Parameters& parameters, const TurnPrior& prior)
    : parameters_(parameters), prior_(prior) {
  ConstantsMatrix covariance;
  Constants with_bias;
  for (int i = 0; i < 5; ++i) {
    with_bias[i] = prior.covariance(kConstants[i], kBias);
    for (int j = 0; j < 5; ++j) covariance(i, j) = prior.covariance(kConstants[i], kConstants[j]);
    // Held: no row will touch it, and what stands here only keeps the matrix regular.
    if (held(kConstants[i])) covariance(i, i) = 1;
  }
  prior_information_ = base::inverse_symmetric(covariance);
  const Constants slope = prior_information_ * with_bias;
  track_.row(1) << -prior.mean[kBias], slope.transpose();
  covariance_(1, 1) = std::max(prior.covariance(kBias, kBias) - with_bias.dot(slope), 0.0);
  solve();
}

bool TurnFilter::held(int coefficient) const { return prior_.covariance(coefficient, coefficient) == 0; }

TurnFilter::Reading TurnFilter::reading(double measured_rad) const {
  const double s1 = std::sin(measured_rad), c1 = std::cos(measured_rad);
  const double s2 = std::sin(2 * measured_rad), c2 = std::cos(2 * measured_rad);
  Reading reading;
  reading.row << unwrapped_rad_, 0, s1, c1, s2, c2;
  reading.slope << 1, 0, c1, -s1, 2 * c2, -2 * s2;
  for (int i = 1; i < 5; ++i) {
    const int in_row = 1 + i;
    const double believed = prior_.mean[kConstants[i]];
    reading.row[0] -= reading.row[in_row] * believed;
    reading.slope[0] -= reading.slope[in_row] * believed;
    if (held(kConstants[i])) reading.row[in_row] = reading.slope[in_row] = 0;
  }
  return reading;
}

void TurnFilter::update(const TurnStep& step) {
  Eigen::Matrix<double, 6, 1> all;
  all << step.time_s, step.heading_rad, step.duration_s, step.measured_angle_rad, step.bias_time_s,
      step.tilt_angle_rad;
  const bool begins = step.begins_segment || !in_segment_;
  if (!all.allFinite() || (!begins && step.duration_s <= 0)) {
    ++left_out_;
    in_segment_ = false;
    return;
  }
  if (begins) {
    start(step);
  } else {
    unwrap(step);
    predict(step);
    correct(step.heading_rad);
    solve();
  }
  in_segment_ = true;
  measured_rad_ = step.heading_rad;
  time_s_ = step.time_s;
  ++readings_;
}

double TurnFilter::scale_as_known() const {
  return prior_.mean[kScale] + shrunk(solution_.departure[0], solution_.covariance(0, 0));
}

void TurnFilter::unwrap(const TurnStep& step) {
  // The gyro predicts the turn as far as its calibration is known. The deviation changes little between
  // readings.
  const double scale = scale_as_known();
  const double bias =
      prior_.mean[kBias] + shrunk(estimate()[kBias] - prior_.mean[kBias], unscaled_covariance()(kBias, kBias));
  const double turn = scale * step.measured_angle_rad + bias * step.bias_time_s + step.tilt_angle_rad;
  unwrapped_rad_ += turn + base::wrapped(step.heading_rad - measured_rad_ - turn);
  // Whole turns are dropped, so that a long mission does not cost digits.
  const double whole = unwrapped_rad_ - base::wrapped(unwrapped_rad_);
  unwrapped_rad_ -= whole;
  track_(0, 0) += whole;
}

void TurnFilter::start(const TurnStep& step) {
  const double heading_variance = parameters_.heading_noise_rad * parameters_.heading_noise_rad;
  const double pause_s = readings_ > 0 ? std::max(step.time_s - time_s_, 0.0) : 0;
  unwrapped_rad_ = base::wrapped(step.heading_rad);
  const Reading first = reading(step.heading_rad);
  track_.row(0) = -first.row.transpose();
  covariance_(0, 0) = heading_variance;
  covariance_(0, 1) = covariance_(1, 0) = 0;
  covariance_(1, 1) += parameters_.bias_walk_rad_s_sqrt_s * parameters_.bias_walk_rad_s_sqrt_s * pause_s;
  noise_.start(first.slope, heading_variance);
}

void TurnFilter::predict(const TurnStep& step) {
  Row by_rate = Row::Zero();
  by_rate[0] = -prior_.mean[kScale];
  if (!held(kScale)) by_rate[1] = 1;
  track_.row(0) += step.bias_time_s * track_.row(1) + step.measured_angle_rad * by_rate.transpose();
  track_(0, 0) -= step.tilt_angle_rad;

  // White noise of the rate through F, which is bias_time / duration.
  const double angle_noise = parameters_.rate_noise_rad_sqrt_s * step.bias_time_s;
  const double angle_variance = angle_noise * angle_noise / step.duration_s;
  const double scale = scale_as_known();
  const double walk = parameters_.bias_walk_rad_s_sqrt_s;
  Eigen::Matrix2d transition;
  transition << 1, step.bias_time_s, 0, 1;
  covariance_ = transition * covariance_ * transition.transpose();
  covariance_(0, 0) += scale * scale * angle_variance;
  covariance_(1, 1) += walk * walk * step.duration_s;
  noise_.predict(step.bias_time_s, by_rate, angle_variance);
}

void TurnFilter::correct(double measured_rad) {
  const double heading_variance = parameters_.heading_noise_rad * parameters_.heading_noise_rad;
  const Reading now = reading(measured_rad);
  const Row row = now.row + track_.row(0).transpose();
  const double variance = covariance_(0, 0) + heading_variance;
  const Eigen::Vector2d gain = covariance_.col(0) / variance;

  products_ += row * row.transpose() / variance;
  log_variances_ += std::log(variance);
  ++innovations_;
  noise_.correct(now.slope, heading_variance, variance, gain);

  Eigen::Matrix2d keep = Eigen::Matrix2d::Identity();
  keep.col(0) -= gain;
  track_ -= gain * row.transpose();
  covariance_ = keep * covariance_ * keep.transpose() + gain * gain.transpose() * heading_variance;
}

void TurnFilter::solve() {
  const ConstantsMatrix from_data = products_.bottomRightCorner<5, 5>();
  const ConstantsMatrix information = from_data + prior_information_;
  const Constants moment = products_.bottomLeftCorner<5, 1>();
  const Eigen::LLT<ConstantsMatrix> factors(information);
  solution_.departure = factors.solve(moment);
  log_likelihood_ = -(log_variances_ + 2 * factors.matrixLLT().diagonal().array().log().sum() + products_(0, 0) -
                      moment.dot(solution_.departure)) /
                    2;
  // The ratio of the actual to the stated noise is taken at the estimate, which depends on that ratio. Two
  // passes are enough.
  constexpr int kPasses = 2;
  for (int pass = 0; pass < kPasses; ++pass) {
    Row at_estimate;
    at_estimate << 1, -solution_.departure;
    solution_.square = at_estimate.dot(products_ * at_estimate);
    solution_.expected_square = at_estimate.dot(noise_.expected() * at_estimate);
    const TurnNoise::Products noise = noise_.expected() * reduced_chi_squared();
    const ConstantsMatrix noise_information = noise.bottomRightCorner<5, 5>();
    if (ConstantsMatrix(information - 2 * noise_information).llt().info() != Eigen::Success) {
      solution_.departure.setZero();
      solution_.covariance = base::inverse_symmetric(prior_information_);
      return;
    }
    const ConstantsMatrix inverse = base::inverse_symmetric(information - noise_information);
    solution_.departure = inverse * (moment - noise.bottomLeftCorner<5, 1>());
    if (pass < kPasses - 1) continue;  // only departure and squares enter the next one
    // The subtraction made the information smaller, not the noise; and a compass whose deviation falls with the
    // heading shows less noise than its readings have.
    const double noise_seen = innovations_ > 0 ? solution_.expected_square / static_cast<double>(innovations_) : 1;
    solution_.covariance = noise_seen * inverse * information * inverse;
  }
}

double TurnFilter::reduced_chi_squared() const {
  const auto sought = static_cast<std::uint64_t>(std::count(prior_.sought.begin(), prior_.sought.end(), true));
  if (innovations_ < sought + kEnoughInnovations) return 1;
  // The constants sought reduce the degrees of freedom.
  const double left = 1 - static_cast<double>(sought) / static_cast<double>(innovations_);
  return std::max(solution_.square, 0.0) / (solution_.expected_square * left);
}

TurnCoefficients TurnFilter::estimate() const {
  TurnCoefficients all = prior_.mean;
  for (int i = 0; i < 5; ++i) all[kConstants[i]] += solution_.departure[i];
  all[kBias] = -track_(1, 0) + track_.row(1).tail<5>().dot(solution_.departure);
  return all;
}

TurnCovariance TurnFilter::unscaled_covariance() const {
  TurnCovariance all;
  const Eigen::Matrix<double, 1, 5> by_constants = track_.row(1).tail<5>();
  const Eigen::Matrix<double, 1, 5> with_bias = by_constants * solution_.covariance;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) all(kConstants[i], kConstants[j]) = solution_.covariance(i, j);
    all(kBias, kConstants[i]) = all(kConstants[i], kBias) = with_bias[i];
  }
  all(kBias, kBias) = covariance_(1, 1) + with_bias.dot(by_constants);
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

double TurnFilter::heading_rad() const {
  return base::wrapped(-track_(0, 0) + track_.row(0).tail<5>().dot(solution_.departure));
}

void TurnFilter::archive(Archive& archive) {
  archive.tag("turn_filter 2");
  archive(prior_.mean, prior_.covariance, prior_.sought, prior_information_);
  archive(track_, covariance_, noise_, products_, log_variances_, solution_, log_likelihood_, measured_rad_,
          unwrapped_rad_, time_s_, in_segment_, readings_, innovations_, left_out_);
}

}  // namespace navcal::calib

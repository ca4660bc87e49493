// SPDX-License-Identifier: Apache-2.0
#include "calib/delay/delay_field.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/square.h"
#include "base/vectors.h"

namespace navcal::calib {
namespace {

constexpr double kFieldPrior_uT = 100;
constexpr std::uint64_t kReadingsForNoise = 100;

}  // namespace

FieldDelay::FieldDelay(const Parameters& parameters) : parameters_(parameters) {
  Vector std;
  std.segment<3>(kField).setConstant(kFieldPrior_uT);
  std.segment<3>(kHardIron).setConstant(parameters.hard_iron_std_uT);
  std.segment<3>(kBias).setConstant(parameters.bias_std_rad_s);
  std.segment<3>(kDelayIron).setConstant(parameters.hard_iron_std_uT * parameters.delay_std_s);
  std[kDelay] = parameters.delay_std_s;
  covariance_ = std.array().square().matrix().asDiagonal();
}

void FieldDelay::forget(int first, double std) {
  covariance_.middleRows<3>(first).setZero();
  covariance_.middleCols<3>(first).setZero();
  covariance_.block<3, 3>(first, first) = base::square(std) * Eigen::Matrix3d::Identity();
}

void FieldDelay::update(const CompassReading& compass) {
  if (!compass.field_body_uT || compass.faulty || !std::isfinite(compass.time_s) ||
      !compass.field_body_uT->allFinite())
    return;
  if (field_) ++left_out_;
  field_ = Field{compass.time_s, *compass.field_body_uT};
}

void FieldDelay::update(const RateReading& rate) {
  if (rate.saturated || !std::isfinite(rate.time_s) || !rate.rate_rad_s.allFinite()) {
    rate_.reset();
    ++left_out_;
    return;
  }
  const double step_s = rate_ ? rate.time_s - rate_->time_s : 0;
  if (rate_ && step_s <= 0) return;
  const bool joined = rate_ && step_s <= parameters_.longest_gap_s;
  // The turn was not seen: where the field points now has to be found anew.
  if (!joined) forget(kField, kFieldPrior_uT);
  if (field_ && field_->time_s <= rate.time_s) {
    if (joined && field_->time_s >= rate_->time_s) {
      const double share = (field_->time_s - rate_->time_s) / step_s;
      const Eigen::Vector3d at = rate_->value + share * (rate.rate_rad_s - rate_->value);
      advance((rate_->value + at) / 2, share * step_s);
      correct(field_->value, at);
      rate_ = Rate{field_->time_s, at};
    } else {
      ++left_out_;
    }
    field_.reset();
  }
  if (joined) advance((rate_->value + rate.rate_rad_s) / 2, rate.time_s - rate_->time_s);
  rate_ = Rate{rate.time_s, rate.rate_rad_s};
}

void FieldDelay::advance(const Eigen::Vector3d& mean_rate_rad_s, double duration_s) {
  if (duration_s <= 0) return;
  const double angle_rad = mean_rate_rad_s.norm() * duration_s;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  // The body turns one way, the field in it the other.
  if (angle_rad > 0) turn = Eigen::AngleAxisd(-angle_rad, mean_rate_rad_s.normalized()).toRotationMatrix();
  const Eigen::Matrix3d by_bias = duration_s * base::cross_product_matrix(last_field_uT_);
  auto field = state_.segment<3>(kField);
  field = (turn * field + by_bias * state_.segment<3>(kBias)).eval();
  const Eigen::Matrix<double, 3, kStates> rows =
      turn * covariance_.middleRows<3>(kField) + by_bias * covariance_.middleRows<3>(kBias);
  const Eigen::Matrix3d corner =
      rows.middleCols<3>(kField) * turn.transpose() + rows.middleCols<3>(kBias) * by_bias.transpose();
  covariance_.middleRows<3>(kField) = rows;
  covariance_.middleCols<3>(kField) = rows.transpose();
  covariance_.block<3, 3>(kField, kField) = (corner + corner.transpose()) / 2;
  covariance_.diagonal().segment<3>(kField).array() += base::square(parameters_.walk_uT_sqrt_s) * duration_s;
}

void FieldDelay::correct(const Eigen::Vector3d& field_uT, const Eigen::Vector3d& rate_rad_s) {
  Eigen::Matrix<double, 3, kStates> rows = Eigen::Matrix<double, 3, kStates>::Zero();
  rows.middleCols<3>(kField).setIdentity();
  rows.middleCols<3>(kHardIron).setIdentity();
  rows.middleCols<3>(kDelayIron) = -base::cross_product_matrix(rate_rad_s);
  rows.col(kDelay) = rate_rad_s.cross(field_uT);
  const Eigen::Matrix<double, kStates, 3> response = covariance_ * rows.transpose();
  const Eigen::Matrix3d variance =
      rows * response + base::square(parameters_.field_noise_uT) * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d innovation = field_uT - rows * state_;
  const Eigen::LDLT<Eigen::Matrix3d> solver(variance);
  const double surprise = innovation.dot(solver.solve(innovation));
  last_field_uT_ = field_uT;
  if (surprise > parameters_.gate) {
    ++left_out_;
    if (++rejected_in_a_row_ < parameters_.rejected_for_step) return;
    rejected_in_a_row_ = 0;
    ++field_steps_;
    forget(kField, kFieldPrior_uT);
    forget(kHardIron, parameters_.hard_iron_std_uT);
    forget(kDelayIron, parameters_.hard_iron_std_uT * parameters_.delay_std_s);
    return;
  }
  rejected_in_a_row_ = 0;
  const Eigen::Matrix<double, kStates, 3> gain = solver.solve(response.transpose()).transpose();
  state_ += gain * innovation;
  covariance_ -= gain * response.transpose();
  covariance_ = ((covariance_ + covariance_.transpose()) / 2).eval();
  chi_squared_ += surprise;
  blocks_.update(state_[kDelay], covariance_(kDelay, kDelay));
  rate_square_sum_ += rate_rad_s.squaredNorm();
  rate_sum_ += rate_rad_s;
  ++readings_;
}

Delay FieldDelay::estimate() const {
  if (readings_ == 0) return {};
  const auto n = static_cast<double>(readings_);
  // The noise of the field and the errors of its rotation are not known beforehand, so the residuals give them.
  const double noise_scale = readings_ < kReadingsForNoise ? 1 : chi_squared_ / (3 * n);
  return {.delay_s = state_[kDelay],
          .std_s = std::sqrt(covariance_(kDelay, kDelay) * blocks_.variance_scale(noise_scale)),
          .readings = readings_,
          .rate_spread_rad_s = std::sqrt(std::max(0.0, rate_square_sum_ / n - (rate_sum_ / n).squaredNorm()))};
}

void FieldDelay::archive(Archive& archive) {
  archive.tag("field_delay 2");
  archive(state_, covariance_, rate_, field_, last_field_uT_, chi_squared_, blocks_, rate_square_sum_, rate_sum_);
  archive(readings_, left_out_, rejected_in_a_row_, field_steps_);
}

}  // namespace navcal::calib

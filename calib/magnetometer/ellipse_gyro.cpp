// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipse_gyro.h"

#include <Eigen/Dense>
#include <bit>
#include <cmath>
#include <limits>

#include "calib/magnetometer/ellipse_chain.h"
#include "calib/magnetometer/ellipse_judgement.h"
#include "calib/magnetometer/field_cells.h"

namespace navcal::calib {
namespace {

constexpr double kGroupTurn_rad = 0.035;
constexpr double kGroupTime_s = 1;
constexpr std::size_t kFirstChainFit = 20;  // groups
constexpr int kMostChainIterations = 200;

}  // namespace

void TurnGroup::archive(Archive& archive) {
  archive(count, field_uT, begins_segment, time_s, measured_angle_rad, bias_time_s, tilt_angle_rad, vertical);
}

EllipseGyro::EllipseGyro(const Parameters& parameters) : parameters_(parameters) {
  groups_.reserve(kCapacity + 1);
  chain_.gyro = parameters.gyro.mean;
}

void EllipseGyro::update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad,
                         const TurnStep& turn) {
  const Eigen::Vector2d field = levelled(field_body_uT, roll_rad, pitch_rad);
  const Eigen::Vector4d way(turn.duration_s, turn.measured_angle_rad, turn.bias_time_s, turn.tilt_angle_rad);
  if (!field.allFinite() || field.cwiseAbs().maxCoeff() > kHighestField_uT || !way.allFinite()) {
    broken_ = true;  // the way to the next reading is not known
    return;
  }
  add(field, vertical_in_level(roll_rad, pitch_rad), way, turn.begins_segment || broken_);
  broken_ = false;
  ++samples_;
  if (groups_.size() < kFirstChainFit || samples_ % static_cast<std::uint64_t>(parameters_.slice_samples) != 0)
    return;
  if (!shape_found_ || std::has_single_bit(samples_ / static_cast<std::uint64_t>(parameters_.slice_samples))) {
    shape_found_ = start(chain_, groups_, parameters_.gyro);
  }
  if (shape_found_) iterate();
}

void EllipseGyro::add(const Eigen::Vector2d& field_uT, const Eigen::Vector2d& vertical, const Eigen::Vector4d& way,
                      bool begins_segment) {
  if (begins_segment)
    way_.setZero();
  else
    way_ += way;
  // Sums since the segment began; a group keeps those at the mean of its readings.
  if (!begins_segment && !groups_.empty()) {
    TurnGroup& group = groups_.back();
    const Eigen::Vector4d from = way_ - group_begin_;
    const double turned = parameters_.gyro.mean[0] * from[1] + parameters_.gyro.mean[1] * from[2] + from[3];
    const Eigen::Vector2d by_gyro = from.segment<2>(1);
    const double unsure = std::sqrt(by_gyro.dot(parameters_.gyro.covariance * by_gyro));
    if (std::abs(turned) + unsure < kGroupTurn_rad && from[0] < kGroupTime_s) {
      group.count += 1;
      const double gain = 1 / group.count;
      group.field_uT += gain * (field_uT - group.field_uT);
      group.vertical += gain * (vertical - group.vertical);
      group.time_s += gain * (way_[0] - group.time_s);
      group.measured_angle_rad += gain * (way_[1] - group.measured_angle_rad);
      group.bias_time_s += gain * (way_[2] - group.bias_time_s);
      group.tilt_angle_rad += gain * (way_[3] - group.tilt_angle_rad);
      return;
    }
  }
  if (groups_.size() == kCapacity) {
    // A quarter at once, so that moving the rest costs little per reading.
    constexpr std::ptrdiff_t kQuarter = kCapacity / 4;
    groups_.erase(groups_.begin(), groups_.begin() + kQuarter);
    if (chain_.headings_rad.size() > kQuarter) {
      chain_.headings_rad.erase(chain_.headings_rad.begin(), chain_.headings_rad.begin() + kQuarter);
    }
    groups_.front().begins_segment = true;
  }
  group_begin_ = way_;
  groups_.push_back({1, field_uT, begins_segment, way_[0], way_[1], way_[2], way_[3], vertical});
}

void EllipseGyro::iterate() {
  improve(chain_, groups_, parameters_.gyro, {parameters_.noise_uT, parameters_.rate_noise_rad_sqrt_s});
}

void EllipseGyro::set_gyro(const GyroBelief& gyro) { parameters_.gyro = gyro; }

void EllipseGyro::settle() {
  shape_found_ = groups_.size() >= kFirstChainFit && start(chain_, groups_, parameters_.gyro);
  for (int i = 0; shape_found_ && !chain_.settled && i < kMostChainIterations; ++i) iterate();
}

EllipseGyro::Matrix EllipseGyro::covariance() const { return chain_.covariance; }

std::optional<EllipseShape> EllipseGyro::shape() const {
  return shape_found_ ? std::optional(chain_.shape) : std::nullopt;
}

std::optional<MagnetometerEstimate> EllipseGyro::estimate() const {
  if (!shape_found_) return std::nullopt;
  return level_estimate(chain_.shape, stated_covariance(0), chain_.residual_uT, samples_);
}

void EllipseGyro::archive(Archive& archive) {
  archive.tag("ellipse_gyro 2");
  archive(parameters_.gyro, groups_, chain_, shape_found_, broken_, way_, group_begin_, samples_);
}

}  // namespace navcal::calib

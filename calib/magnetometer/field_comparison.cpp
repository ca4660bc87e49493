// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/field_comparison.h"

#include <algorithm>

#include "calib/magnetometer/ellipsoid_shape.h"

namespace navcal::calib {
namespace {

/// Weight of the blocks before, for each new one.
constexpr double kForgetting = 0.9;

}  // namespace

void FieldComparison::Spread::Moments::add(double value) {
  ++count;
  sum += value;
  square += value * value;
}

double FieldComparison::Spread::Moments::end() {
  if (!(count > 0)) return 0;
  const double block_mean = sum / count;
  weight = kForgetting * weight + 1;
  mean += (block_mean - mean) / weight;
  const double departure = square / count - 2 * mean * block_mean + mean * mean;
  count = sum = square = 0;
  return std::max(departure, 0.0);
}

void FieldComparison::Spread::add(const Eigen::Vector3d& field_uT, const std::optional<Eigen::Vector3d>& down) {
  size_.add(field_uT.norm());
  if (down) vertical_.add(down->dot(field_uT));
}

double FieldComparison::Spread::end() {
  const double departure = size_.end() + vertical_.end();
  return departure / (size_.mean * size_.mean);
}

void FieldComparison::begin(const Correction& in_force, const Correction& estimates) {
  // All three begin with the same blocks, so that none has a mean that suits it better.
  if (estimate_.has_value() != estimates.magnetometer.has_value()) raw_ = with_in_force_ = with_estimate_ = {};
  in_force_ = in_force.magnetometer;
  estimate_ = estimates.magnetometer;
}

bool FieldComparison::update(const CompassReading& reading, const Correction& in_force,
                             const Correction& estimates) {
  if (!reading.field_body_uT) return false;
  if (readings_ == 0) begin(in_force, estimates);
  std::optional<Eigen::Vector3d> down;
  if (reading.roll_rad && reading.pitch_rad) down = down_in_body(*reading.roll_rad, *reading.pitch_rad);
  const Eigen::Vector3d& field_uT = *reading.field_body_uT;
  raw_.add(field_uT, down);
  with_in_force_.add(in_force_ ? (*in_force_)(field_uT) : field_uT, down);
  if (estimate_) with_estimate_.add((*estimate_)(field_uT), down);
  if (++readings_ < kReadings) return false;
  readings_ = 0;
  const double before = raw_.end(), now = with_in_force_.end();
  if (!estimate_) return false;
  comparison_.add(before, now, with_estimate_.end());
  return true;
}

void FieldComparison::on_change() {
  comparison_.on_change();
  raw_ = with_in_force_ = with_estimate_ = {};
  readings_ = 0;
}

void FieldComparison::archive(Archive& archive) {
  archive.tag("field_comparison 1");
  archive(in_force_, estimate_, raw_, with_in_force_, with_estimate_, readings_, comparison_);
}

}  // namespace navcal::calib

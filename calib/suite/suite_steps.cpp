// SPDX-License-Identifier: Apache-2.0
// A step of the field and the calibration in force.
#include <algorithm>
#include <utility>

#include "calib/suite/suite.h"

namespace navcal::calib {
namespace {

/// A deviation is of the field in which it was learnt. Iron can be moved, and what a reference says of the
/// calibrated field holds on.
bool is_of_one_field(Calibrator calibrator) {
  const CalibratorRow& row = row_of(calibrator);
  return row.corrects == Corrects::heading && calibrator != Calibrator::magnetometer &&
         row.applies_to != AppliesTo::field;
}

/// True when the iron is known well enough for a heading, at the tilt of a vehicle that is not turned over.
bool is_known(const IronShift& shift) {
  constexpr double kWell_uT = 1, kShare = 0.25, kTilt_rad = 0.175;
  const Eigen::Vector3d std_uT = shift.variance_uT2.cwiseSqrt();
  const double worst_uT = std::max({std_uT.x(), std_uT.y(), kTilt_rad * std_uT.z()});
  return worst_uT < std::max(kWell_uT, kShare * shift.by_uT.norm());
}

}  // namespace

void Suite::follow_field() {
  constexpr double kLeastMove_uT = 0.05;
  constexpr Calibrator kIron = Calibrator::magnetometer;
  if (const auto moves = estimators_.magnetometer().moves(); moves != std::exchange(followed_moves_, moves)) {
    FieldStep& move = told_move_.emplace();
    move.is_place = true;
    move.returned = !estimators_.magnetometer().is_elsewhere();
    change_field(&move);
  }
  const FieldHistory& history = estimators_.magnetometer().history();
  const std::uint32_t steps = estimators_.magnetometer().field_steps();
  const std::uint32_t withdrawn = estimators_.magnetometer().withdrawn_steps();
  const bool is_withdrawn = withdrawn != std::exchange(followed_withdrawn_, withdrawn);
  // A step may be withdrawn and the next one told between two calls.
  std::uint32_t before = std::exchange(followed_steps_, steps);
  if (is_withdrawn && before > 0) --before;
  learnt_steps_ = std::min(learnt_steps_, is_withdrawn ? before : steps);
  if (learnt_steps_ + history.steps().size() <
      steps) {  // steps that the history has dropped do not change any more
    learnt_steps_ = before;
    moved_ = {};
  }
  const IronShift shift = history.shift_over(steps - learnt_steps_);
  const Eigen::Vector3d by_uT = shift.by_uT - moved_.by_uT;
  if (steps == before && !is_withdrawn && (by_uT.array().abs() < kLeastMove_uT).all()) return;
  moved_ = shift;
  in_force_.move_hard_iron(by_uT);
  flags_[index_of(kIron)].adopted |= has(in_force_.correction(), kIron);
  if (!is_known(shift)) {
    leave(kIron, {});
  } else if (flags_[index_of(kIron)].left) {
    come_back(kIron);
  }
  const bool has_returned = steps > before && history.steps().back().returned;
  const auto& iron = in_force_.correction().magnetometer;
  const Magnetometer& magnetometer = estimators_.magnetometer();
  // Readings of the field that is back judge what was adopted in the other one.
  if (has_returned && iron && magnetometer.scatter_of_size(*iron) > magnetometer.scatter_of_size({})) {
    leave(kIron, {});
    flags_[index_of(kIron)].left = false;
  }
  if (is_withdrawn) change_field(nullptr);
  if (steps > before) change_field(&history.steps().back());
}

void Suite::leave(Calibrator calibrator, const Correction& rest) {
  if (!has(in_force_.correction(), calibrator)) return;
  in_force_.adopt(calibrator, rest);
  flags_[index_of(calibrator)].left = flags_[index_of(calibrator)].adopted = true;
  estimators_.on_in_force(calibrator, in_force_.correction());
}

void Suite::come_back(Calibrator calibrator) {
  flags_[index_of(calibrator)].left = false;
  if (!in_force_.roll_back(calibrator)) return;
  flags_[index_of(calibrator)].adopted = true;
  estimators_.on_in_force(calibrator, in_force_.correction());
}

void Suite::change_field(const FieldStep* step) {
  for (const Calibrator calibrator : calibrators()) {
    const CalibratorRow& row = row_of(calibrator);
    if (row.corrects == Corrects::heading) held_out_.forget(calibrator);
    if (is_of_one_field(calibrator)) {
      bool& left = flags_[index_of(calibrator)].left;
      Correction rest;  // A is of every field
      if (const auto& by_gps = in_force_.correction().gps_compass)
        rest.gps_compass = DeviationCorrection{{by_gps->coefficients_rad[0]}};
      if (left && (step == nullptr || step->returned)) {
        come_back(calibrator);
      } else if (step != nullptr) {
        left = false;
        leave(calibrator, rest);
      }
    } else if (row.corrects != Corrects::offset || in_force_.correction().magnetometer) {
      continue;
    }
    if (step != nullptr && row.of_compass) estimators_.unit(calibrator).start();
  }
  held_out_.on_change();
  field_.forget();
  for (const Calibrator calibrator : judged_) refresh_accepted(calibrator);
}

void Suite::forget_field() {
  followed_steps_ = followed_withdrawn_ = told_steps_ = learnt_steps_ = followed_moves_ = 0;
  moved_ = {};
}

}  // namespace navcal::calib

// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/held_out.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angles.h"

namespace navcal::calib {
namespace {

/// Weight of a block relative to the next newer block.
constexpr double kForgetting = 0.9;
/// Calibrators with a number in stored states that correct the heading.
constexpr std::size_t kNamedHeadings = 4;
/// A block with a smaller turn does not distinguish deviations.
constexpr double kLeastTurn_rad = 0.5;

}  // namespace

void Comparison::Sums::add(double before_square, double in_force_square, double estimate_square, double gain) {
  before = kForgetting * before + before_square;
  in_force = kForgetting * in_force + in_force_square;
  estimate = kForgetting * estimate + estimate_square;
  gain_square = kForgetting * gain_square + gain * gain;
  weight = kForgetting * weight + 1;
  weight_square = kForgetting * kForgetting * weight_square + 1;
  ++blocks;
}

double Comparison::Sums::rms(double sum) const { return weight > 0 ? std::sqrt(sum / weight) : 0; }

double Comparison::Sums::significance(double gain, double squares) const {
  if (blocks < 2) return 0;
  const double mean = gain / weight;
  const double others = weight * weight / weight_square - 1;  // blocks that count, less one
  const double variance = std::max(squares / weight - mean * mean, 0.0) / others;
  return variance > 0 ? mean / std::sqrt(variance) : mean > 0 ? kLeastStandardErrors : 0;
}

void Comparison::add(double before_square, double in_force_square, double estimate_square) {
  all_.add(before_square, in_force_square, estimate_square, before_square - in_force_square);
  since_change_.add(before_square, in_force_square, estimate_square, in_force_square - estimate_square);
}

bool Comparison::gains(double from, double to, double squares, double margin) const {
  const Sums& s = since_change_;
  return s.blocks >= kLeastBlocks && s.significance(from - to, squares) >= kLeastStandardErrors &&
         s.rms(to) < (1 - margin) * s.rms(from);
}

bool Comparison::better_by(double margin) const {
  return gains(since_change_.in_force, since_change_.estimate, since_change_.gain_square, margin);
}

bool Comparison::worse_by(double margin) const {
  return gains(since_change_.in_force, since_change_.before, all_.gain_square, margin);
}

bool Comparison::contradicts() const {
  const Sums& s = since_change_;
  return s.blocks >= kLeastBlocks && s.rms(s.estimate) > s.rms(s.in_force);
}

void HeldOut::Scatter::add(double residual_rad) {
  // The departure is taken from the mean so far, so that a residual near plus or minus pi does not jump.
  const double departure = base::wrapped(residual_rad - mean);
  ++count;
  mean += departure / count;
  sum += departure * departure * (count - 1) / count;
}

void HeldOut::Block::archive(Archive& archive) {
  archive(in_force, estimates, readings, measured_rad, measured_b_rad, bias_s, tilt_rad, least_turn_rad,
          most_turn_rad, before, with_in_force, with_all);
  for (std::size_t i = 0; i < kNamedHeadings; ++i) archive(with[i]);
  archive(gyros);
}

HeldOut::HeldOut() : comparisons_(calibrators().size()) {
  for (const Calibrator calibrator : calibrators()) {
    if (row_of(calibrator).corrects == Corrects::heading) headings_.push_back(calibrator);
  }
  block_.with.resize(headings_.size());
  with_.resize(headings_.size());
}

const Comparison& HeldOut::of(Calibrator calibrator) const { return comparisons_[index_of(calibrator)]; }

void HeldOut::on_change() {
  for (Comparison& comparison : comparisons_) comparison.on_change();
  heading_.on_change();
  in_block_ = false;
}

void HeldOut::forget(Calibrator calibrator) {
  comparisons_[index_of(calibrator)] = {};
  in_block_ = false;
}

void HeldOut::begin(const Correction& in_force, const Correction& estimates) {
  std::vector<Scatter> with = std::move(block_.with);  // keeps its memory
  std::fill(with.begin(), with.end(), Scatter{});
  block_ = {};
  block_.with = std::move(with);
  block_.in_force = in_force;
  block_.estimates = estimates;
  in_block_ = true;
  combine();
}

void HeldOut::combine() {
  with_all_ = block_.in_force;
  for (const Calibrator calibrator : calibrators()) {
    if (has(block_.estimates, calibrator)) copy_value(with_all_, block_.estimates, calibrator);
  }
  for (std::size_t i = 0; i < headings_.size(); ++i) {
    with_[i] = block_.in_force;
    copy_value(with_[i], block_.estimates, headings_[i]);
  }
}

bool HeldOut::update(const CompassReading& reading, const TurnStep& step, const Correction& in_force,
                     const Correction& estimates) {
  if (!in_block_ || step.begins_segment) {
    begin(in_force, estimates);
  } else {
    block_.measured_rad += step.measured_angle_rad;
    block_.measured_b_rad += step.measured_angle_b_rad;
    block_.bias_s += step.bias_time_s;
    block_.tilt_rad += step.tilt_angle_rad;
  }
  // One block is of one kind of reading: a heading of the field cannot be compared with one without.
  const bool needs_field = block_.in_force.magnetometer || block_.estimates.magnetometer;
  if (!reading.heading_rad || (needs_field && !reading.field_body_uT)) return false;
  judge_headings(reading);
  judge_gyros(reading);
  if (++block_.readings < kReadings) return false;
  end();
  in_block_ = false;
  return true;
}

double HeldOut::turn(const std::optional<RateCorrection>& gyro, bool b) const {
  const double measured_rad = b ? block_.measured_b_rad : block_.measured_rad;
  const RateCorrection correction = gyro.value_or(RateCorrection{});
  return correction.scale * measured_rad + correction.bias_rad_s * block_.bias_s + block_.tilt_rad;
}

const std::optional<RateCorrection>& HeldOut::reference_gyro() const {
  return block_.estimates.gyro ? block_.estimates.gyro : block_.in_force.gyro;
}

void HeldOut::judge_headings(const CompassReading& reading) {
  if (!reference_gyro()) return;
  const double turn_rad = turn(reference_gyro(), false);
  block_.least_turn_rad = std::min(block_.least_turn_rad, turn_rad);
  block_.most_turn_rad = std::max(block_.most_turn_rad, turn_rad);
  const auto residual = [&](const Correction& correction) {
    return best_heading(correction, reading).value_or(0) - turn_rad;
  };
  block_.before.add(*reading.heading_rad - turn_rad);
  block_.with_in_force.add(residual(block_.in_force));
  block_.with_all.add(residual(with_all_));
  for (std::size_t i = 0; i < headings_.size(); ++i) {
    if (has(block_.estimates, headings_[i])) block_.with[i].add(residual(with_[i]));
  }
}

void HeldOut::judge_gyros(const CompassReading& reading) {
  const double heading_rad = best_heading(with_all_, reading).value_or(0);
  for (std::size_t i = 0; i < kGyros.size(); ++i) {
    if (!has(block_.estimates, kGyros[i])) continue;
    const bool b = kGyros[i] == Calibrator::gyro_b;
    block_.gyros[i].before.add(heading_rad - turn(std::nullopt, b));
    block_.gyros[i].in_force.add(heading_rad - turn(b ? block_.in_force.gyro_b : block_.in_force.gyro, b));
    block_.gyros[i].estimate.add(heading_rad - turn(b ? block_.estimates.gyro_b : block_.estimates.gyro, b));
  }
}

void HeldOut::end() {
  for (std::size_t i = 0; i < kGyros.size(); ++i) {
    const auto& [before, in_force, estimate] = block_.gyros[i];
    if (estimate.count > 0) {
      comparisons_[index_of(kGyros[i])].add(before.square(), in_force.square(), estimate.square());
    }
  }
  if (!reference_gyro() || block_.most_turn_rad - block_.least_turn_rad < kLeastTurn_rad) return;
  const double before = block_.before.square(), in_force = block_.with_in_force.square();
  heading_.add(before, in_force, block_.with_all.square());
  for (std::size_t i = 0; i < headings_.size(); ++i) {
    if (block_.with[i].count > 0)
      comparisons_[index_of(headings_[i])].add(before, in_force, block_.with[i].square());
  }
}

void HeldOut::archive(Archive& archive) {
  archive.tag("held_out 1");
  archive(block_, in_block_);
  for (std::size_t i = 0; i < kNamedCalibrators; ++i) archive(comparisons_[i]);
  archive(heading_);
  if (!archive.saving()) combine();
}

void HeldOut::forget_added(Calibrator calibrator) {
  comparisons_[index_of(calibrator)] = {};
  const auto found = std::find(headings_.begin(), headings_.end(), calibrator);
  if (found != headings_.end()) block_.with[static_cast<std::size_t>(found - headings_.begin())] = {};
}

void HeldOut::archive_added(Archive& archive, Calibrator calibrator) {
  archive(comparisons_[index_of(calibrator)]);
  const auto found = std::find(headings_.begin(), headings_.end(), calibrator);
  if (found != headings_.end()) archive(block_.with[static_cast<std::size_t>(found - headings_.begin())]);
}

}  // namespace navcal::calib

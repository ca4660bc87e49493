// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/magnetometer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace navcal::calib {
namespace {

/// A run begins after a pause of at least half of what the clock is put forward by at a restart (Gate).
constexpr double kRunGap_s = 1800;
/// Readings as a run begins that show whether it is at another place.
constexpr std::size_t kArrival = 20;

bool is_another(const KnownField& field, const KnownField& before) {
  constexpr double kSize_uT = 1, kDip_rad = 0.02;
  return std::abs(field.magnitude_uT - before.magnitude_uT) > kSize_uT ||
         std::abs(field.dip_rad - before.dip_rad) > kDip_rad;
}

}  // namespace

void Magnetometer::Reading::archive(Archive& archive) {
  archive(field_body_uT, roll_rad, pitch_rad, has_turn, turn.time_s, turn.heading_rad, turn.begins_segment);
  archive(turn.duration_s, turn.measured_angle_rad, turn.measured_angle_b_rad, turn.bias_time_s,
          turn.tilt_angle_rad);
  archive(time_s, utc_ns);
}

void Magnetometer::Waiting::archive(Archive& archive) {
  archive(reading, predicted.cell, predicted.tilt_error_rad, number);
}

Magnetometer::Estimators::Estimators(const Parameters& parameters)
    : ellipse(parameters.ellipse), gyro(parameters.gyro), ellipsoid(parameters.ellipsoid),
      predictor(parameters.ellipsoid.noise_uT, parameters.ellipsoid.known), known(parameters.ellipsoid.known) {}

void Magnetometer::Estimators::update(const Reading& reading, const PredictedReading& predicted) {
  ellipse.update(reading.field_body_uT, reading.roll_rad, reading.pitch_rad);
  ellipsoid.update(reading.field_body_uT, reading.roll_rad, reading.pitch_rad);
  if (reading.has_turn) gyro.update(reading.field_body_uT, reading.roll_rad, reading.pitch_rad, reading.turn);
  predictor.update(predicted, [this] { return ellipsoid.cells(); });
}

void Magnetometer::Estimators::set_known(const std::optional<KnownField>& field) {
  known = field;
  ellipsoid.set_known(field);
}

void Magnetometer::Estimators::settle() {
  ellipse.settle();
  gyro.settle();
  ellipsoid.settle();
}

void Magnetometer::Estimators::archive(Archive& archive) { archive(ellipse, gyro, ellipsoid, predictor); }

Magnetometer::Magnetometer(const Parameters& parameters) : parameters_(parameters), now_(parameters) {}

void Magnetometer::update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad) {
  Reading reading;
  reading.field_body_uT = field_body_uT;
  reading.roll_rad = roll_rad;
  reading.pitch_rad = pitch_rad;
  update(reading);
}

void Magnetometer::update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad,
                          const TurnStep& turn) {
  Reading reading;
  reading.field_body_uT = field_body_uT;
  reading.roll_rad = roll_rad;
  reading.pitch_rad = pitch_rad;
  reading.has_turn = true;
  reading.turn = turn;
  reading.time_s = turn.time_s;
  update(reading);
}

PredictedReading Magnetometer::predicted_of(const Reading& reading) const {
  // Readings without times are given the interval of a compass at its usual rate.
  constexpr double kUsualInterval_s = 0.1, kLongestInterval_s = 2;
  PredictedReading predicted;
  predicted.cell = cell_of(reading.field_body_uT, reading.roll_rad, reading.pitch_rad);
  const Eigen::Vector3d down = predicted.cell.mean.tail<3>();
  if (!last_down_ || down.isZero(0)) return predicted;
  const double since_s = reading.time_s - last_time_s_;
  const double interval_s = since_s > 0 ? std::min(since_s, kLongestInterval_s) : kUsualInterval_s;
  predicted.tilt_error_rad = parameters_.tilt_lag_s * (down - *last_down_).norm() / interval_s;
  return predicted;
}

void Magnetometer::update(const Reading& reading) {
  ++readings_;
  answer_.reset();
  if (!reading.field_body_uT.allFinite() || reading.field_body_uT.cwiseAbs().maxCoeff() > kHighestField_uT) {
    leave_out();
    return;
  }
  const Waiting next{reading, predicted_of(reading), readings_};
  if (const Eigen::Vector3d down = next.predicted.cell.mean.tail<3>(); !down.isZero(0)) {
    last_down_ = down;
    last_time_s_ = reading.time_s;
  }
  if (!is_arriving_ && !history_.segments().empty() &&
      reading.time_s - history_.segments().back().end_s > kRunGap_s) {
    release();  // what came before the pause is of the place before
    watch_.reset();
    past_.clear();
    is_arriving_ = true;
  }
  waiting_.push_back(next);
  if (is_arriving_ && waiting_.size() < kArrival) return;
  if (std::exchange(is_arriving_, false)) return is_at_another_place() ? begin_place() : release();
  const bool suspicious = watch_.update(now_.predictor.surprise(next.predicted));
  if (watch_.since_onset() == 0) {
    release();
  } else if (suspicious && waiting_.size() >= std::min<std::size_t>(next_decision_, FieldStepWatch::kLongest)) {
    decide();
  }
}

void Magnetometer::leave_out() {
  ++left_out_;
  turn_broken_ = true;
}

void Magnetometer::use(const Waiting& waiting) {
  // The turn over readings that were left out is not the one since the last that was used.
  Reading used = waiting.reading;
  used.turn.begins_segment = used.turn.begins_segment || turn_broken_;
  turn_broken_ = false;
  now_.update(used, waiting.predicted);
  history_.add(waiting.predicted.cell, used.time_s, used.utc_ns);
  if (history_.is_time_to_refine()) refine_history();
  constexpr std::size_t kPast = 64;
  past_.push_back(waiting.predicted.cell);
  if (past_.size() > kPast) past_.pop_front();
}

void Magnetometer::refine_history(bool is_sure) {
  if (!history_.refine(now_.predictor.noise(), now_.predictor.belief(), is_sure) || !before_) return;
  // There was no step: the readings before it are of the same field.
  now_.ellipse.absorb(before_->ellipse);
  now_.ellipsoid.absorb(before_->ellipsoid);
  before_.reset();
  --field_steps_;
  ++withdrawn_steps_;
}

void Magnetometer::release() {
  for (const Waiting& waiting : waiting_) {
    if (FieldStepWatch::is_off(now_.predictor.surprise(waiting.predicted))) {
      leave_out();
    } else {
      use(waiting);
    }
  }
  waiting_.clear();
  next_decision_ = 0;
}

std::optional<FieldStep> Magnetometer::last_step() const {
  return history_.steps().empty() ? std::nullopt : std::optional(history_.steps().back());
}

void Magnetometer::set_gyro(const GyroBelief& gyro) {
  answer_.reset();
  parameters_.gyro.gyro = gyro;
  now_.gyro.set_gyro(gyro);
  if (before_) before_->gyro.set_gyro(gyro);
}

void Magnetometer::set_tilt_noise(double tilt_noise_rad) {
  parameters_.ellipsoid.tilt_noise_rad = tilt_noise_rad;
  now_.ellipsoid.set_tilt_noise(tilt_noise_rad);
}

void Magnetometer::set_known_field(const std::optional<KnownField>& known) {
  answer_.reset();
  parameters_.ellipsoid.known = known;
  if (known && now_.known && is_another(*known, *now_.known)) begin_place();
  now_.set_known(known);
  if (before_ && !is_elsewhere_) before_->set_known(known);
}

/// True when what waits disagrees with what is known of the field, or is of a size that was never seen. A level
/// vehicle knows nothing of the vertical, so that there any field agrees.
bool Magnetometer::is_at_another_place() const {
  constexpr double kSurprising = 4, kMost = 25, kBeyond = 0.15;  // as for a step; of the size
  double surprise = 0, size_uT = 0, least_uT = INFINITY, most_uT = 0;
  for (const Waiting& waiting : waiting_) {
    surprise += std::min(now_.predictor.surprise(waiting.predicted), kMost) / kArrival;
    size_uT += waiting.reading.field_body_uT.norm() / kArrival;
  }
  for (const auto& cell : now_.ellipsoid.cells()) {
    least_uT = std::min(least_uT, cell.mean.head<3>().norm());
    most_uT = std::max(most_uT, cell.mean.head<3>().norm());
  }
  return surprise > kSurprising || size_uT < (1 - kBeyond) * least_uT || size_uT > (1 + kBeyond) * most_uT;
}

void Magnetometer::begin_place() {
  history_.begin_place();
  const bool is_better_before = is_elsewhere_ && chosen(now_).method == Method::none;
  if (!is_better_before) {
    before_ = now_;
    before_->settle();
  }
  now_ = Estimators(parameters_);
  is_elsewhere_ = true;
  ++moves_;
  use_waiting();
}

void Magnetometer::settle() {
  answer_.reset();
  release();
  watch_.reset();
  refine_history();
  now_.settle();
}

void Magnetometer::archive(Archive& archive) {
  const bool has_place =
      archive.tag_either("magnetometer 3", "magnetometer 4", moves_ > 0 || now_.known || is_arriving_);
  answer_.reset();
  archive(parameters_.gyro.gyro, now_, watch_, history_, field_steps_, withdrawn_steps_, readings_, left_out_,
          turn_broken_);
  archive(last_down_, last_time_s_, next_decision_);
  const auto archive_list = [&](auto& list) {
    std::uint64_t count = list.size();
    archive(count);
    if (!archive.saving()) list.assign(archive.ok() && count <= FieldStepWatch::kLongest ? count : 0, {});
    for (auto& one : list) archive(one);
  };
  archive_list(waiting_);
  archive_list(past_);
  bool has_before = before_.has_value();
  archive(has_before);
  if (!archive.saving()) {
    before_.reset();
    if (archive.ok() && has_before) before_.emplace(parameters_);
  }
  if (before_) archive(*before_);
  if (has_place) {
    archive(is_elsewhere_, moves_, is_arriving_, now_.known);
    if (before_) archive(before_->known);
  }
  if (archive.saving()) return;
  is_elsewhere_ = is_elsewhere_ && before_;  // a damaged state may say otherwise
  now_.ellipsoid.set_known(now_.known ? now_.known : parameters_.ellipsoid.known);
  if (before_) before_->ellipsoid.set_known(before_->known ? before_->known : parameters_.ellipsoid.known);
}

}  // namespace navcal::calib

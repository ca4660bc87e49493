#include "calib/magnetometer.h"

#include <algorithm>
#include <cmath>

namespace navcal::calib {

void Magnetometer::Reading::archive(Archive& archive) {
  archive(field_body_uT, roll_rad, pitch_rad, has_turn, turn.time_s, turn.heading_rad, turn.begins_segment);
  archive(turn.duration_s, turn.measured_angle_rad, turn.measured_angle_b_rad, turn.bias_time_s,
          turn.tilt_angle_rad);
}

Magnetometer::Estimators::Estimators(const Parameters& parameters)
    : ellipse(parameters.ellipse), gyro(parameters.gyro), ellipsoid(parameters.ellipsoid) {}

void Magnetometer::Estimators::update(const Reading& reading) {
  ellipse.update(reading.field_body_uT, reading.roll_rad, reading.pitch_rad);
  ellipsoid.update(reading.field_body_uT, reading.roll_rad, reading.pitch_rad);
  if (reading.has_turn) gyro.update(reading.field_body_uT, reading.roll_rad, reading.pitch_rad, reading.turn);
}

double Magnetometer::Estimators::surprise(const Reading& reading) const {
  return std::max(ellipse.surprise(reading.field_body_uT, reading.roll_rad, reading.pitch_rad),
                  ellipsoid.surprise(reading.field_body_uT));
}

void Magnetometer::Estimators::archive(Archive& archive) { archive(ellipse, gyro, ellipsoid); }

Magnetometer::Magnetometer(const Parameters& parameters) : parameters_(parameters), now_(parameters) {}

void Magnetometer::update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad) {
  take({field_body_uT, roll_rad, pitch_rad, false, TurnStep{}});
}

void Magnetometer::update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad,
                          const TurnStep& turn) {
  take({field_body_uT, roll_rad, pitch_rad, true, turn});
}

void Magnetometer::take(const Reading& reading) {
  ++readings_;
  answer_.reset();
  if (!reading.field_body_uT.allFinite() || reading.field_body_uT.cwiseAbs().maxCoeff() > kHighestField_uT ||
      !std::isfinite(reading.roll_rad) || !std::isfinite(reading.pitch_rad)) {
    leave_out();
    return;
  }
  recent_[readings_ % recent_.size()] = reading;
  const double surprise = now_.surprise(reading);
  if (watch_.update(surprise)) {
    change_field();
  } else if (FieldStepWatch::is_off(surprise)) {
    leave_out();
  } else {
    // The turn over readings that were left out is not the one since the last that was used.
    Reading used = reading;
    used.turn.begins_segment = used.turn.begins_segment || turn_broken_;
    turn_broken_ = false;
    now_.update(used);
  }
}

void Magnetometer::leave_out() {
  ++left_out_;
  turn_broken_ = true;
}

void Magnetometer::change_field() {
  const std::uint64_t count = watch_.since_onset();
  const std::uint64_t first = readings_ + 1 - count;
  FieldStep step{first, readings_, false};
  double surprise_before = 0;
  if (before_) {
    for (std::uint64_t i = first; i <= readings_; ++i) {
      surprise_before += std::min(before_->surprise(recent_[i % recent_.size()]), 25.0);
    }
  }
  // Judged as the watch judges: on the mean less than two standard deviations off.
  constexpr double kFits = 4;
  step.returned = before_ && surprise_before < kFits * static_cast<double>(count);
  Estimators next = step.returned ? *before_ : Estimators(parameters_);
  before_ = now_;
  now_ = std::move(next);
  bool begins = true;
  for (std::uint64_t i = first; i <= readings_; ++i) {
    Reading reading = recent_[i % recent_.size()];
    reading.turn.begins_segment = reading.turn.begins_segment || begins;
    begins = false;
    now_.update(reading);
  }
  turn_broken_ = false;
  watch_.reset();
  ++field_steps_;
  last_step_ = step;
}

void Magnetometer::set_gyro(const GyroBelief& gyro) {
  answer_.reset();
  parameters_.gyro.gyro = gyro;
  now_.gyro.set_gyro(gyro);
  if (before_) before_->gyro.set_gyro(gyro);
}

void Magnetometer::settle() {
  answer_.reset();
  now_.ellipse.settle();
  now_.gyro.settle();
  now_.ellipsoid.settle();
}

void Magnetometer::archive(Archive& archive) {
  archive.tag("magnetometer 1");
  answer_.reset();
  archive(parameters_.gyro.gyro, now_, watch_, recent_, field_steps_, last_step_, readings_, left_out_,
          turn_broken_);
  bool has_before = before_.has_value();
  archive(has_before);
  if (!archive.saving()) {
    before_.reset();
    if (archive.ok() && has_before) before_.emplace(parameters_);
  }
  if (before_) archive(*before_);
}

}  // namespace navcal::calib

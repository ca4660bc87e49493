// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/estimators.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include "calib/suite/reading_queue.h"

namespace navcal::calib {
namespace {

/// A scale known no better does not serve the other calibrators.
constexpr double kServingScaleStd = 0.03;

TurnFilter::Parameters turn_parameters(const SuiteOptions& options) {
  return {.heading_noise_rad = options.heading_noise_rad,
          .rate_noise_rad_sqrt_s = options.rate_noise_rad_sqrt_s,
          .bias_walk_rad_s_sqrt_s = options.bias_walk_rad_s_sqrt_s};
}

Magnetometer::Parameters field_parameters(const SuiteOptions& options) {
  Magnetometer::Parameters parameters;
  parameters.ellipse.noise_uT = options.field_noise_uT;
  parameters.gyro.noise_uT = options.field_noise_uT;
  parameters.gyro.rate_noise_rad_sqrt_s = options.rate_noise_rad_sqrt_s;
  parameters.ellipsoid.noise_uT = options.field_noise_uT;
  parameters.ellipsoid.known = options.local_field.known;
  parameters.ellipsoid.tilt_noise_rad = options.tilt_noise_rad;
  if (options.tilt_lag_s > 0) parameters.tilt_lag_s = options.tilt_lag_s;  // else accelerometers show the tilt
  return parameters;
}

DelayEstimator::Parameters delay_parameters(const SuiteOptions& options) {
  DelayEstimator::Parameters parameters;
  parameters.heading.heading_noise_rad = options.heading_noise_rad;
  parameters.heading.rate_noise_rad_sqrt_s = options.rate_noise_rad_sqrt_s;
  parameters.field.field_noise_uT = options.field_noise_uT;
  parameters.course.velocity_std_m_s = options.velocity_noise_m_s;
  parameters.tilt_lag_s = options.tilt_lag_s;
  parameters.tilt_noise_rad = options.tilt_noise_rad;
  return parameters;
}

}  // namespace

Estimators::Estimators(const SuiteOptions& options)
    : options_(options),
      turns_({.tilt_lag_s = options.tilt_lag_s,
              .tilt_noise_rad = options.tilt_noise_rad,
              .rate_noise_rad_sqrt_s = options.rate_noise_rad_sqrt_s}),
      gyro_(TurnCalibrator::Subject::gyro, turn_parameters(options)),
      gyro_b_(TurnCalibrator::Subject::gyro, turn_parameters(options)),
      compass_(TurnCalibrator::Subject::compass, turn_parameters(options)),
      magnetometer_(field_parameters(options)),
      surface_(options),
      delays_(delay_parameters(options)),
      gyros_({}),
      motor_current_({options.field_noise_uT, options.rate_noise_rad_sqrt_s}) {}

void Estimators::update(const CompassReading& measured, const Correction& in_force) {
  motor_current_.update(measured, in_force.motor_current.value_or(MotorCurrentCorrection{}).slope_uT_per_A);
  const CompassReading original =
      without_motor_field(in_force, measured, motor_current_.current().at_or_newest(measured.time_s));
  delays_.update(original);
  CompassReading reading = original;
  reading.time_s -= in_force.compass_delay_s.value_or(0);
  heading_seen_ = heading_seen_ || reading.heading_rad.has_value();
  if (!heading_seen_ && reading.field_body_uT && reading.pitch_rad && reading.roll_rad)
    reading.heading_rad = levelled_heading(*reading.field_body_uT, *reading.roll_rad, *reading.pitch_rad);
  turns_.update(reading);
  // next() is called after every reading: it makes room.
  pending_[(first_pending_ + pending_count_) % kPending] = reading;
  ++pending_count_;
}

void Estimators::update(const MotorReading& reading, const Correction& in_force) {
  wait(reading, in_force);
  motor_current_.update(reading);
}

void Estimators::wait(const Reading& reading, const Correction& in_force) {
  if (beside_.size() == kBeside) release(beside_.front().key_s, in_force);
  // The gate gives the motor card's word out ahead of its time.
  auto place = beside_.end();
  while (place != beside_.begin() && std::prev(place)->key_s > time_of(reading)) --place;
  beside_.insert(place, {time_of(reading), reading});
}

void Estimators::release(double time_s, const Correction& in_force) {
  for (; !beside_.empty() && beside_.front().key_s <= time_s; beside_.pop_front()) {
    if (const auto* ground = std::get_if<GroundReading>(&beside_.front().reading)) {
      surface_.update(*ground, in_force);
      delays_.update(*ground);
    } else if (const auto* motor = std::get_if<MotorReading>(&beside_.front().reading)) {
      surface_.update(*motor);
    }
  }
}

void Estimators::finish() {
  finishing_ = true;
  motor_current_.finish();
}

void Estimators::update(const RateReading& reading) {
  motor_current_.update(reading);
  turns_.update(reading);
  delays_.update(reading);
  gyros_.update(reading);
}

void Estimators::update(const GroundReading& reading, const Correction& in_force) { wait(reading, in_force); }

std::optional<TurnedReading> Estimators::next(const Correction& in_force) {
  for (;;) {
    if (!turn_) turn_ = turns_.next(finishing_);
    if (pending_count_ == 0) {
      if (finishing_) release(std::numeric_limits<double>::infinity(), in_force);
      turn_.reset();
      finishing_ = false;
      return std::nullopt;
    }
    const double time_s = pending_[first_pending_].time_s;
    std::optional<TurnStep> turn;
    if (turn_ && turn_->time_s <= time_s) {
      turn = std::exchange(turn_, std::nullopt);
      if (turn->time_s < time_s) continue;  // of a reading that was given up
    } else if (!turn_ && pending_count_ < kPending && !finishing_) {
      return std::nullopt;
    }
    const TurnedReading turned = take_pending(turn);
    release(turned.reading.time_s, in_force);
    learn(turned, in_force);
    return turned;
  }
}

TurnedReading Estimators::take_pending(std::optional<TurnStep> turn) {
  TurnedReading turned{pending_[first_pending_], turn};
  first_pending_ = (first_pending_ + 1) % kPending;
  --pending_count_;
  return turned;
}

std::optional<RateCorrection> Estimators::known_gyro(const Correction& in_force) const {
  if (in_force.gyro) return in_force.gyro;
  if (!gyro_.has_estimate()) return std::nullopt;
  if (!(gyro_.filter().covariance()(kScale, kScale) <= kServingScaleStd * kServingScaleStd)) return std::nullopt;
  const TurnCoefficients estimate = gyro_.filter().estimate();
  return RateCorrection{estimate[kScale], estimate[kBias]};
}

void Estimators::learn(const TurnedReading& turned, const Correction& in_force) {
  if (turned.turn) {
    gyro_.update(*turned.turn);
    gyro_b_.update(turned.turn->with_gyro_b());
    compass_.update(*turned.turn);
    learn_swing(*turned.turn, in_force);
  }
  learn_field(turned);
  double turn_rate_rad_s = 0;
  if (const auto gyro = known_gyro(in_force)) {
    turns_.set_gyro(gyro->scale, gyro->bias_rad_s);
    if (const auto& turn = turned.turn; turn && !turn->begins_segment && turn->duration_s > 0) {
      turn_rate_rad_s =
          (gyro->scale * turn->measured_angle_rad + gyro->bias_rad_s * turn->bias_time_s + turn->tilt_angle_rad) /
          turn->duration_s;
    }
  }
  const WaterTrackReading track = surface_.track_of(turned.reading, turn_rate_rad_s);
  surface_.update(turned.reading, track, in_force);
  if (turned.reading.heading_rad) delays_.update(track);
}

void Estimators::learn_field(const TurnedReading& turned) {
  const auto& reading = turned.reading;
  if (!reading.field_body_uT) return;
  // The size of the field tells of its iron without tilt, too.
  Magnetometer::Reading field;
  field.field_body_uT = *reading.field_body_uT;
  // Where the gyros are known, without the inclinometer's lag.
  field.roll_rad = turned.turn ? turned.turn->roll_rad : reading.roll_rad.value_or(NAN);
  field.pitch_rad = turned.turn ? turned.turn->pitch_rad : reading.pitch_rad.value_or(NAN);
  // Smoothed tilt is several times as good as a reading of the inclinometer.
  constexpr double kSmoothing = 3.6;
  if (turned.turn) {
    magnetometer_.set_tilt_noise(options_.tilt_noise_rad / (turned.turn->tilt_restored ? kSmoothing : 1));
  }
  field.has_turn = turned.turn.has_value();
  if (turned.turn) field.turn = *turned.turn;
  field.time_s = reading.time_s;
  field.utc_ns = reading.utc_ns;
  magnetometer_.update(field);
}

/// The reference is the calibrated gyro, begun at the compass's own heading: what the swing finds is right but for
/// a constant, which is A.
void Estimators::learn_swing(const TurnStep& turn, const Correction& in_force) {
  if (!swing_) return;
  const auto gyro = known_gyro(in_force);
  if (!gyro) return;
  if (!swing_anchored_) {
    swing_reference_rad_ = turn.heading_rad;
  } else if (turn.begins_segment) {
    // Nothing better is known of the turn across a gap.
    swing_reference_rad_ += std::remainder(turn.heading_rad - swing_heading_rad_, 2 * std::numbers::pi);
  } else {
    swing_reference_rad_ +=
        gyro->scale * turn.measured_angle_rad + gyro->bias_rad_s * turn.bias_time_s + turn.tilt_angle_rad;
  }
  swing_anchored_ = true;
  swing_heading_rad_ = turn.heading_rad;
  swing_->update(turn.time_s, turn.heading_rad, swing_reference_rad_);
}

void Estimators::set_local_field(const LocalField& field) {
  options_.local_field = field;
  magnetometer_.set_known_field(field.known);
  surface_.set_declination(field.declination_rad);
}

TurnPrior Estimators::compass_prior() const {
  if (!gyro_.judgement().accepted) return TurnPrior::unknown_both();
  const TurnCoefficients gyro = gyro_.filter().estimate();
  return TurnPrior::unknown_compass(gyro[kScale], gyro[kBias], gyro_.filter().covariance().topLeftCorner<2, 2>());
}

void Estimators::start(Calibrator calibrator) {
  switch (calibrator) {
    case Calibrator::gyro:
      return gyro_.start();
    case Calibrator::gyro_b:
      return gyro_b_.start();
    case Calibrator::compass:
      return compass_.start(compass_prior());
    case Calibrator::magnetometer:
      magnetometer_ = Magnetometer(field_parameters(options_));
      return tell_magnetometer_of_gyro();
    case Calibrator::gps_compass:
    case Calibrator::misalignment:
      return surface_.start(calibrator);
    case Calibrator::swing:
      swing_.emplace();
      swing_anchored_ = false;
      return;
    case Calibrator::compass_delay:
    case Calibrator::course_delay:
      delays_ = DelayEstimator(delay_parameters(options_));
      return;
    case Calibrator::motor_current:
      return motor_current_.start();
  }
}

void Estimators::tell_magnetometer_of_gyro() {
  if (!gyro_.judgement().accepted) return;
  const TurnCoefficients gyro = gyro_.filter().estimate();
  magnetometer_.set_gyro({gyro.head<2>(), gyro_.filter().covariance().topLeftCorner<2, 2>()});
}

void Estimators::on_in_force(Calibrator calibrator, const Correction& in_force) {
  const auto line = [](const std::optional<RateCorrection>& rate) {
    return GyroPair::Line{rate.value_or(RateCorrection{}).scale, rate.value_or(RateCorrection{}).bias_rad_s};
  };
  switch (calibrator) {
    case Calibrator::gyro:
      tell_magnetometer_of_gyro();
      gyros_.set_calibration(line(in_force.gyro), line(in_force.gyro_b));
      break;
    case Calibrator::gyro_b:
      gyros_.set_calibration(line(in_force.gyro), line(in_force.gyro_b));
      break;
    case Calibrator::compass:
    case Calibrator::magnetometer:
    case Calibrator::gps_compass:
    case Calibrator::swing:
      surface_.start(Calibrator::misalignment);  // it was found for another heading
      break;
    case Calibrator::misalignment:
      surface_.on_change();
      break;
    case Calibrator::motor_current:
      motor_current_.on_change();
      // The field that they learn from is another one now.
      for (const Calibrator other :
           {Calibrator::magnetometer, Calibrator::compass, Calibrator::gps_compass, Calibrator::misalignment}) {
        start(other);
      }
      break;
    case Calibrator::compass_delay:
    case Calibrator::course_delay:
      break;
  }
}

void Estimators::archive(Archive& archive) {
  archive.tag("estimators 3");
  archive(turns_, gyro_, gyro_b_, compass_, magnetometer_, surface_, delays_, gyros_, motor_current_, swing_,
          swing_reference_rad_, swing_heading_rad_, swing_anchored_);
  for (CompassReading& reading : pending_) calib::archive(archive, reading);
  archive(first_pending_, pending_count_, heading_seen_, finishing_);
  std::uint64_t beside = beside_.size();
  archive(beside);
  if (!archive.saving()) beside_.resize(archive.ok() && beside <= kBeside ? beside : 0);
  for (QueuedReading& reading : beside_) reading.archive(archive);
  bool has_turn = turn_.has_value();
  archive(has_turn);
  if (!archive.saving()) turn_ = has_turn ? std::optional(TurnStep{}) : std::nullopt;
  if (turn_) turn_->archive(archive);
  if (first_pending_ >= kPending || pending_count_ > kPending) first_pending_ = pending_count_ = 0;
}

}  // namespace navcal::calib

// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/estimators.h"

#include <iterator>
#include <limits>
#include <utility>

namespace navcal::calib {
namespace {

/// A scale known no better does not serve the other calibrators.
constexpr double kServingScaleStd = 0.03;

}  // namespace

Estimators::Estimators(const SuiteOptions& options)
    : options_(options), turns_({.tilt_lag_s = options.tilt_lag_s,
                                 .tilt_noise_rad = options.tilt_noise_rad,
                                 .rate_noise_rad_sqrt_s = options.rate_noise_rad_sqrt_s}),
      shared_(std::make_unique<SharedEstimators>(options)) {
  for (const Calibrator calibrator : calibrators()) {
    units_.push_back(row_of(calibrator).make(options, *shared_));
    units_.back()->set_calibrator(calibrator);
  }
}

void Estimators::update(const CompassReading& measured, const Correction& in_force) {
  for (const auto& unit : units_) unit->update_measured(measured, in_force);
  const CompassReading original =
      without_motor_field(in_force, measured, shared_->motor_current.current().at_or_newest(measured.time_s));
  for (const auto& unit : units_) unit->update_compass(original);
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
  for (const auto& unit : units_) unit->update_motor(reading);
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
      for (const auto& unit : units_) unit->update_ground(*ground, in_force);
    } else if (const auto* motor = std::get_if<MotorReading>(&beside_.front().reading)) {
      for (const auto& unit : units_) unit->update_shaft(*motor);
    }
  }
}

void Estimators::finish() {
  finishing_ = true;
  for (const auto& unit : units_) unit->finish();
}

void Estimators::settle() {
  for (const auto& unit : units_) unit->settle();
}

void Estimators::update(const RateReading& reading) {
  turns_.update(reading);
  for (const auto& unit : units_) unit->update_rate(reading);
}

void Estimators::update(const GroundReading& reading, const Correction& in_force) { wait(reading, in_force); }

void Estimators::update(const ReferenceReading& reading) {
  for (const auto& unit : units_) unit->update_reference(reading);
}

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
  const TurnCalibrator& gyro = shared_->gyro;
  if (!gyro.has_estimate()) return std::nullopt;
  if (!(gyro.filter().covariance()(kScale, kScale) <= kServingScaleStd * kServingScaleStd)) return std::nullopt;
  const TurnCoefficients estimate = gyro.filter().estimate();
  return RateCorrection{estimate[kScale], estimate[kBias]};
}

void Estimators::learn(const TurnedReading& turned, const Correction& in_force) {
  if (turned.turn) {
    for (const auto& unit : units_) unit->update_turn(*turned.turn);
  }
  double turn_rate_rad_s = 0;
  const auto gyro = known_gyro(in_force);
  if (gyro) {
    turns_.set_gyro(gyro->scale, gyro->bias_rad_s);
    if (const auto& turn = turned.turn; turn && !turn->begins_segment && turn->duration_s > 0) {
      turn_rate_rad_s =
          (gyro->scale * turn->measured_angle_rad + gyro->bias_rad_s * turn->bias_time_s + turn->tilt_angle_rad) /
          turn->duration_s;
    }
  }
  const WaterTrackReading track = shared_->gps.track_of(turned.reading, turn_rate_rad_s);
  const LearntReading learnt{turned.reading, turned.turn, track, gyro, in_force};
  for (const auto& unit : units_) unit->update_learnt(learnt);
}

void Estimators::set_local_field(const LocalField& field) {
  options_.local_field = field;
  for (const auto& unit : units_) unit->on_local_field(options_);
}

void Estimators::on_in_force(Calibrator calibrator, const Correction& in_force) {
  for (const auto& unit : units_) unit->on_in_force(calibrator, in_force);
}

Correction Estimators::estimates() const {
  Correction estimates;
  for (const auto& unit : units_) unit->put_estimate(estimates);
  return estimates;
}

void Estimators::archive(Archive& archive) {
  archive.tag("estimators 3");
  archive(turns_);
  // The order of this layout is older than the table. Units without a line here have their state in one of these.
  for (const Calibrator calibrator :
       {Calibrator::gyro, Calibrator::gyro_b, Calibrator::compass, Calibrator::magnetometer,
        Calibrator::gps_compass, Calibrator::compass_delay})
    unit(calibrator).archive(archive);
  archive(shared_->gyros);
  for (const Calibrator calibrator : {Calibrator::motor_current, Calibrator::swing})
    unit(calibrator).archive(archive);
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

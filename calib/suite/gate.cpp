// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/gate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/magnetometer/field_cells.h"

namespace navcal::calib {
namespace {

constexpr std::array<std::string_view, kRejections> kRejectionNames{
    "not_finite", "absurd",         "repeated",          "reversed",           "faulty",         "saturated",
    "frozen",     "motor_switched", "tilt_out_of_range", "field_out_of_range", "field_too_large"};
constexpr std::array<std::string_view, kStreams> kStreamNames{"compass", "imu", "gps", "motor"};

/// A pause after which an instrument's readings begin a new segment.
constexpr std::array<double, kStreams> kGap_s{1, 1, 5, 1};
/// Noise changes the last digit of every instrument more often than this.
constexpr std::uint32_t kFrozenLength = 10;
constexpr double kFrozen_s = 0.9;
/// Number of readings in a row with earlier stamps after which the time scale is taken as restarted.
constexpr std::uint32_t kReversedUntilRestart = 50;

// Limits of plausible readings. No vehicle and no planet exceeds them.
constexpr double kMaxHeading_rad = 2 * std::numbers::pi + 0.01;
constexpr double kMaxPitch_rad = std::numbers::pi / 2 + 0.01;
constexpr double kMaxRoll_rad = std::numbers::pi + 0.01;
constexpr double kMinField_uT = 0.001;
constexpr double kMaxRate_rad_s = 35;
constexpr double kMaxSpecificForce_m_s2 = 200;
constexpr double kMaxSpeed_m_s = 50;
constexpr double kMaxDistance_m = 1e6;
constexpr double kMaxRpm = 1e5;
constexpr double kMaxCurrent_A = 1e3;

enum class Fitness : std::uint8_t { good, not_finite, absurd };

Fitness fitness(double value, double limit) {
  if (!std::isfinite(value)) return Fitness::not_finite;
  return std::abs(value) <= limit ? Fitness::good : Fitness::absurd;
}

template <class Vector>
Fitness fitness_of_all(const Vector& values, double limit) {
  Fitness worst = Fitness::good;
  for (const double value : values) {
    const Fitness one = fitness(value, limit);
    if (one == Fitness::not_finite) return one;
    if (one != Fitness::good) worst = one;
  }
  return worst;
}

Rejection rejection(Fitness fitness) {
  return fitness == Fitness::not_finite ? Rejection::not_finite : Rejection::absurd;
}

}  // namespace

std::string_view name_of(Rejection rejection) { return kRejectionNames.at(static_cast<std::size_t>(rejection)); }
std::string_view name_of(Stream stream) { return kStreamNames.at(static_cast<std::size_t>(stream)); }

bool Gate::Run::add(const Eigen::Vector4d& next, double time_s) {
  if (length == 0 || next != value) {
    value = next;
    since_s = time_s;
    length = 0;
  }
  ++length;
  return length >= kFrozenLength && time_s - since_s >= kFrozen_s;
}

void Gate::count(Stream stream, Rejection reason) {
  ++counts_.left_out[static_cast<std::size_t>(stream)][static_cast<std::size_t>(reason)];
}

void Gate::restart() {
  restart_pending_ = true;
  newest_s_ = {};
  field_ = heading_ = rates_ = {};
  motor_on_.reset();
  reversed_in_a_row_ = 0;
  ++counts_.restarts;
}

std::optional<double> Gate::admitted_time(Stream stream, double time_s) {
  auto& newest = newest_s_[static_cast<std::size_t>(stream)];
  if (!std::isfinite(time_s)) {
    count(stream, Rejection::not_finite);
    return std::nullopt;
  }
  if (newest && time_s == *newest) {
    count(stream, Rejection::repeated);
    return std::nullopt;
  }
  const bool straggler = !restart_pending_ && time_s + offset_s_ < back_s_;
  if ((newest && time_s < *newest) || straggler) {
    if (++reversed_in_a_row_ < kReversedUntilRestart) {
      count(stream, Rejection::reversed);
      return std::nullopt;
    }
    restart();
  }
  reversed_in_a_row_ = 0;
  newest = time_s;
  if (restart_pending_) offset_s_ = front_s_ + kRestartGap_s - time_s;
  restart_pending_ = false;
  const double gate_s = time_s + offset_s_;
  front_s_ = std::max(front_s_, gate_s);
  return gate_s;
}

void Gate::put(const Reading& original) {
  Reading reading = original;
  const Stream stream = stream_of(reading);
  ++counts_.taken[static_cast<std::size_t>(stream)];
  const auto time_s = admitted_time(stream, time_of(reading));
  if (!time_s) return;
  set_time(reading, *time_s);
  if (!std::visit([this](auto& r) { return clean(r); }, reading)) return;
  if (queue_.full()) queue_.pop();
  // The motor's card says late what it says; its word is taken ahead of the readings that it concerns.
  queue_.push(stream == Stream::motor ? *time_s - options_.motor_lead_s : *time_s, reading);
  watch_frozen(reading);
}

std::optional<Reading> Gate::take() {
  while (!queue_.empty()) {
    if (queue_.front().key_s > front_s_ - kDelay_s && !flushing_ && !queue_.full()) break;
    QueuedReading entry = queue_.front();
    queue_.pop();
    back_s_ = std::max(back_s_, entry.key_s);
    if (release(entry)) return entry.reading;
  }
  if (queue_.empty()) flushing_ = false;
  return std::nullopt;
}

bool Gate::clean(CompassReading& reading) {
  if (reading.faulty) {
    count(Stream::compass, Rejection::faulty);
    return false;
  }
  if (reading.distorted) ++counts_.distorted;
  if (reading.tilt_out_of_range) {
    count(Stream::compass, Rejection::tilt_out_of_range);
    reading.heading_rad.reset();
    reading.pitch_rad.reset();
    reading.roll_rad.reset();
  }
  if (reading.field_out_of_range) {
    count(Stream::compass, Rejection::field_out_of_range);
    reading.heading_rad.reset();
    reading.field_body_uT.reset();
  }
  std::optional<Fitness> found;
  const auto check = [&](auto& value, Fitness fit) {
    if (fit == Fitness::good) return;
    value.reset();
    if (!found || fit == Fitness::not_finite) found = fit;
  };
  if (reading.heading_rad) check(reading.heading_rad, fitness(*reading.heading_rad, kMaxHeading_rad));
  if (reading.pitch_rad) check(reading.pitch_rad, fitness(*reading.pitch_rad, kMaxPitch_rad));
  if (reading.roll_rad) check(reading.roll_rad, fitness(*reading.roll_rad, kMaxRoll_rad));
  if (auto& field = reading.field_body_uT) {
    const Fitness fit = fitness_of_all(*field, kHighestField_uT);
    if (fit == Fitness::absurd) {
      count(Stream::compass, Rejection::field_too_large);
      field.reset();
    } else {
      check(field, fit == Fitness::good && field->norm() < kMinField_uT ? Fitness::absurd : fit);
    }
  }
  if (found) count(Stream::compass, rejection(*found));
  return reading.heading_rad || reading.field_body_uT || reading.pitch_rad || reading.roll_rad;
}

bool Gate::clean(RateReading& reading) {
  if (reading.saturated) {
    count(Stream::rate, Rejection::saturated);
    return false;
  }
  for (const Fitness fit :
       {fitness_of_all(reading.rate_rad_s, kMaxRate_rad_s),
        fitness(reading.yaw_rate_b_rad_s.value_or(0), kMaxRate_rad_s),
        fitness_of_all(reading.specific_force_m_s2.value_or(Eigen::Vector3d::Zero()), kMaxSpecificForce_m_s2)}) {
    if (fit == Fitness::good) continue;
    count(Stream::rate, rejection(fit));
    return false;
  }
  return true;
}

bool Gate::clean(GroundReading& reading) {
  for (const Fitness fit :
       {fitness_of_all(reading.position_m, kMaxDistance_m), fitness(reading.speed_m_s, kMaxSpeed_m_s)}) {
    if (fit == Fitness::good) continue;
    count(Stream::ground, rejection(fit));
    return false;
  }
  if (reading.course_rad && !std::isfinite(*reading.course_rad)) {
    count(Stream::ground, Rejection::not_finite);
    reading.course_rad.reset();
  }
  return true;
}

bool Gate::clean(MotorReading& reading) {
  const Fitness fit = fitness(reading.rpm.value_or(0), kMaxRpm);
  if (fit != Fitness::good) count(Stream::motor, rejection(fit));
  if (reading.current_A && fitness(*reading.current_A, kMaxCurrent_A) != Fitness::good) reading.current_A.reset();
  return fit == Fitness::good && (reading.rpm || reading.current_A);
}

void Gate::watch_frozen(const Reading& reading) {
  if (const auto* compass = std::get_if<CompassReading>(&reading)) {
    if (const auto& field = compass->field_body_uT) {
      if (field_.add({field->x(), field->y(), field->z(), 0}, compass->time_s))
        mark_frozen(&QueuedReading::field_frozen, Stream::compass, field_.since_s);
    }
    if (compass->heading_rad && heading_.add({*compass->heading_rad, 0, 0, 0}, compass->time_s))
      mark_frozen(&QueuedReading::heading_frozen, Stream::compass, heading_.since_s);
  } else if (const auto* rate = std::get_if<RateReading>(&reading)) {
    const auto& r = rate->rate_rad_s;
    if (rates_.add({r.x(), r.y(), r.z(), rate->yaw_rate_b_rad_s.value_or(0)}, rate->time_s))
      mark_frozen(&QueuedReading::rate_frozen, Stream::rate, rates_.since_s);
  }
}

void Gate::mark_frozen(bool QueuedReading::*flag, Stream stream, double since_s) {
  queue_.visit_backwards([&](QueuedReading& entry) {
    if (stream_of(entry.reading) != stream) return true;
    if (entry.*flag || entry.key_s < since_s) return false;
    entry.*flag = true;
    return true;
  });
}

bool Gate::release(QueuedReading& entry) {
  bool usable = true;
  if (auto* compass = std::get_if<CompassReading>(&entry.reading)) {
    usable = release(entry, *compass);
  } else if (entry.rate_frozen) {
    count(Stream::rate, Rejection::frozen);
    usable = false;
  } else if (const auto* motor = std::get_if<MotorReading>(&entry.reading)) {
    watch_motor(*motor);
  }
  if (usable) watch_gap(stream_of(entry.reading), time_of(entry.reading));
  return usable;
}

bool Gate::release(QueuedReading& entry, CompassReading& reading) {
  if (entry.field_frozen || entry.heading_frozen) {
    count(Stream::compass, Rejection::frozen);
    // The compass computes its heading from the field, so it is as unusable as the field.
    reading.heading_rad.reset();
    if (entry.field_frozen) reading.field_body_uT.reset();
  }
  const bool magnetic = reading.heading_rad || reading.field_body_uT;
  if (magnetic && motor_switched_s_ && reading.time_s >= *motor_switched_s_ - options_.motor_lead_s &&
      reading.time_s <= *motor_switched_s_ + options_.motor_settle_s) {
    count(Stream::compass, Rejection::motor_switched);
    reading.heading_rad.reset();
    reading.field_body_uT.reset();
  }
  return reading.heading_rad || reading.field_body_uT || reading.pitch_rad || reading.roll_rad;
}

void Gate::watch_motor(const MotorReading& motor) {
  if (!motor.rpm) return;
  const bool on = std::abs(*motor.rpm) >= options_.motor_on_rpm;
  if (motor_on_ && *motor_on_ != on) motor_switched_s_ = motor.time_s;
  motor_on_ = on;
}

void Gate::watch_gap(Stream stream, double time_s) {
  auto& released = released_s_[static_cast<std::size_t>(stream)];
  if (released && time_s - *released > kGap_s[static_cast<std::size_t>(stream)])
    ++counts_.gaps[static_cast<std::size_t>(stream)];
  released = time_s;
}

void Gate::archive(Archive& archive) {
  archive.tag("gate 4");
  archive(queue_, counts_, newest_s_, released_s_, offset_s_, front_s_, back_s_);
  archive(restart_pending_, flushing_, reversed_in_a_row_, field_, heading_, rates_, motor_on_, motor_switched_s_);
}

}  // namespace navcal::calib

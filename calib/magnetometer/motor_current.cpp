// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/motor_current.h"

#include <algorithm>
#include <cmath>

namespace navcal::calib {
namespace {

/// Readings kept before a change of the current and after the last one: the field must be seen at steady current
/// on both sides, also where the gate leaves out two seconds and a half about a switching of the motor.
constexpr double kLead_s = 12, kTail_s = 12;
/// The gyros' errors grow with the length of a window.
constexpr double kLongest_s = 40;
/// Least period of the readings in a window. Readings that come faster are left out.
constexpr double kLeastPeriod_s = 0.09;
/// Longer pauses of the gyros end a window.
constexpr double kLongestRateGap_s = 0.35;
/// A change of the current is the difference of two means of kInMean readings, kApart_s apart.
constexpr std::size_t kInMean = 4;
constexpr double kApart_s = 1.2;
/// Smaller changes are ignored, because the field of such a current is below the noise.
constexpr double kLeastChange_A = 0.1;
/// Least change that is noticed, in standard errors of a difference of two means.
constexpr double kNoticeable = 5;
/// Weight of each new difference in the mean jitter of the current.
constexpr double kJitterWeight = 0.02;

/// Turn of `rate_rad_s` for `duration_s` as a quaternion that takes earlier body axes to later ones.
Eigen::Quaterniond turn_by(const Eigen::Vector3d& rate_rad_s, double duration_s) {
  const Eigen::Vector3d angle_rad = rate_rad_s * duration_s;
  const double size_rad = angle_rad.norm();
  if (size_rad < 1e-12) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(-size_rad, angle_rad / size_rad));
}

}  // namespace

void CurrentTrack::update(const MotorReading& motor) {
  if (!motor.current_A) return;
  points_[next_] = {motor.time_s, *motor.current_A};
  next_ = (next_ + 1) % kKept;
  count_ = std::min(count_ + 1, kKept);
}

std::optional<double> CurrentTrack::at(double time_s) const {
  for (std::size_t age = 0; age + 1 < count_; ++age) {
    const Point &after = back(age), &before = back(age + 1);
    if (after.time_s < time_s) return std::nullopt;
    if (before.time_s > time_s) continue;
    const double length_s = after.time_s - before.time_s;
    if (length_s > kLongest_s) return std::nullopt;
    const double share = length_s > 0 ? (time_s - before.time_s) / length_s : 1;
    return before.current_A + share * (after.current_A - before.current_A);
  }
  return std::nullopt;
}

std::optional<double> CurrentTrack::newest(double time_s) const {
  if (count_ == 0 || time_s - back(0).time_s > kLongest_s) return std::nullopt;
  return back(0).current_A;
}

std::optional<double> CurrentTrack::at_or_newest(double time_s) const {
  const auto between = at(time_s);
  return between ? between : newest(time_s);
}

void CurrentTrack::archive(Archive& archive) {
  archive(points_, next_, count_);
  if (next_ >= kKept || count_ > kKept) next_ = count_ = 0;
}

void MotorCurrent::update(const RateReading& original) {
  const Rate reading{original.time_s, original.rate_rad_s};
  const bool follows =
      rate_ && reading.time_s > rate_->time_s && reading.time_s - rate_->time_s <= kLongestRateGap_s;
  if (!follows) {
    end_window();
    pending_count_ = 0;
    turned_ = {0, 0, 0, 1};
  } else {
    take_pending(*rate_, reading);
    const Eigen::Vector3d mean = 0.5 * (rate_->rate_rad_s + reading.rate_rad_s);
    const Eigen::Quaterniond turn = turn_by(mean, reading.time_s - rate_->time_s);
    turned_ = (turn * Eigen::Quaterniond(turned_)).normalized().coeffs();
  }
  rate_ = reading;
}

void MotorCurrent::update(const MotorReading& reading) {
  if (!reading.current_A) return;
  if (const auto before_A = current_.newest(reading.time_s)) {
    current_jitter_A_ += kJitterWeight * (std::abs(*reading.current_A - *before_A) - current_jitter_A_);
  }
  current_seen_ = true;
  current_.update(reading);
}

void MotorCurrent::update(const CompassReading& reading, const Eigen::Vector3d& in_force_uT_per_A) {
  in_force_uT_per_A_ = in_force_uT_per_A;
  if (!reading.field_body_uT || pending_count_ == kPending) return;
  pending_[pending_count_++] = {reading.time_s, *reading.field_body_uT};
}

/// Readings between two of the gyros get their turn; those before have none.
void MotorCurrent::take_pending(const Rate& before, const Rate& now) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pending_count_; ++i) {
    const PendingField& field = pending_[i];
    if (field.time_s > now.time_s) {
      pending_[kept++] = field;
      continue;
    }
    const auto current_A = current_.at(field.time_s);
    if (field.time_s < before.time_s || !current_A) continue;
    const double share = (field.time_s - before.time_s) / (now.time_s - before.time_s);
    const Eigen::Vector3d rate = before.rate_rad_s + share * (now.rate_rad_s - before.rate_rad_s);
    const auto turn = turn_by(0.5 * (before.rate_rad_s + rate), field.time_s - before.time_s);
    add({field.time_s, field.field_body_uT, (turn * Eigen::Quaterniond(turned_)).coeffs(), rate, *current_A});
  }
  pending_count_ = kept;
}

double MotorCurrent::change_A() const {
  const std::size_t n = window_.size();
  if (n < 2 * kInMean) return 0;
  const double before_s = window_[n - kInMean].time_s - kApart_s;
  std::size_t last = n - kInMean;
  while (last > 0 && window_[last - 1].time_s > before_s) --last;
  if (last < kInMean) return 0;
  double change_A = 0;
  for (std::size_t i = 0; i < kInMean; ++i)
    change_A += window_[n - 1 - i].current_A - window_[last - 1 - i].current_A;
  return std::abs(change_A) / kInMean;
}

double MotorCurrent::noticeable_A() const {
  // Mean size of a difference of two normal values: 1.13 standard deviations; of two means of n: sqrt(2/n).
  const double noise_A = current_jitter_A_ / 1.13 * std::sqrt(2.0 / kInMean);
  return std::max(kLeastChange_A, kNoticeable * noise_A);
}

void MotorCurrent::add(const MotorFieldReading& reading) {
  if (!window_.empty() && reading.time_s - window_.back().time_s < kLeastPeriod_s) return;
  ++readings_;
  window_.push_back(reading);
  if (change_A() > noticeable_A()) changed_s_ = reading.time_s;
  if (!changed_s_) {
    const auto old = std::find_if(window_.begin(), window_.end(),
                                  [&](const auto& r) { return r.time_s >= reading.time_s - kLead_s; });
    window_.erase(window_.begin(), old);
  } else if (reading.time_s - *changed_s_ > kTail_s || reading.time_s - window_.front().time_s > kLongest_s) {
    end_window();
  }
}

void MotorCurrent::end_window() {
  if (changed_s_) keep(evidence_of(window_, noise_));
  window_.clear();
  changed_s_.reset();
}

void MotorCurrent::keep(const MotorFieldEvidence& evidence) {
  if (!(evidence.values > 0) || !evidence.vector.allFinite()) return;
  if (const auto before = estimate(); before && judgement().accepted) {
    comparison_.add(evidence.mean_square_uT2(Eigen::Vector3d::Zero()),
                    evidence.mean_square_uT2(in_force_uT_per_A_),
                    evidence.mean_square_uT2(before->slope_uT_per_A));
  }
  windows_.push_back(evidence);
  if (windows_.size() < kMostWindows) return;
  for (std::size_t i = 0; i < windows_.size() / 2; ++i) {
    MotorFieldEvidence pair = windows_[2 * i];
    pair.information += windows_[2 * i + 1].information;
    pair.vector += windows_[2 * i + 1].vector;
    pair.freedom += windows_[2 * i + 1].freedom;
    windows_[i] = pair;
  }
  windows_.resize(windows_.size() / 2);
}

void MotorCurrent::finish() { end_window(); }

void MotorCurrent::start() {
  windows_.clear();
  window_.clear();
  changed_s_.reset();
  readings_ = 0;
  comparison_ = {};
}

void MotorCurrent::archive(Archive& archive) {
  archive.tag("motor_current 1");
  archive(current_, rate_, turned_, pending_, pending_count_, window_, changed_s_, current_jitter_A_, windows_);
  archive(in_force_uT_per_A_, readings_, current_seen_, comparison_);
  if (pending_count_ > kPending) pending_count_ = 0;
}

}  // namespace navcal::calib

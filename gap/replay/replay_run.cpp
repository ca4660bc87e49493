// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/replay_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/angles.h"
#include "base/reference_instruments.h"
#include "base/vectors.h"
#include "calib/correction.h"
#include "gap/replay/estimator_gains.h"
#include "sim/rotation.h"
#include "sim/vehicle/steady_advance.h"

namespace navcal::gap {
namespace {

// Gains of the estimator, for each reading or frame. Set by a study of this vehicle.
constexpr double kHeadingGain = 0.02, kTiltGain = 0.05, kRateGain = 0.15;
constexpr double kDriftVariance_m2_s = 0.02;
/// After a longer silence the card has been off, and the estimator begins anew.
constexpr double kRestart_s = 5;
constexpr double kLongestStep_s = 0.06;
/// Longest integration step of the vehicle model. With one step for each frame of the card, a vehicle identical
/// to its model would appear to have quicker fins and a late card, by ten standard errors on a zigzag.
constexpr double kLongestPart_s = 0.026;
constexpr double kSubmerged_s = 10;

Vector3 array_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

Eigen::Vector3d euler_rates(const Eigen::Vector3d& euler_rad, const Eigen::Vector3d& rate_rad_s) {
  const double cf = std::cos(euler_rad[0]), sf = std::sin(euler_rad[0]);
  const double yaw = (sf * rate_rad_s[1] + cf * rate_rad_s[2]) / std::cos(euler_rad[1]);
  return {rate_rad_s[0] + std::sin(euler_rad[1]) * yaw, cf * rate_rad_s[1] - sf * rate_rad_s[2], yaw};
}

/// Body rates about x, y and z from the four gyros; the two about z are averaged.
Vector3 about_axes(const std::array<double, 4>& gyros) { return {gyros[0], gyros[2], (gyros[1] + gyros[3]) / 2}; }

/// Magnetic heading from the compass's own field and tilt.
double heading_of(const Vector3& field, double roll_rad, double pitch_rad) {
  return calib::levelled_heading(base::vector_of(field), roll_rad, pitch_rad);
}

}  // namespace

ReplayRun::ReplayRun(const ReplayInput& input, const Model& model)
    : in_(input),
      effects_(model.effects),
      actuators_(input.actuators, effects_),
      instruments_(effects_, model.bias_rad_s, input.mission.instruments),
      gyro_error_at_rest_rad_s_(about_axes(model.bias_rad_s)) {
  sums_.setZero(in_.intervals, kChannels);
  counts_.setZero(in_.intervals, kChannels);
  const auto fixes = static_cast<Eigen::Index>(in_.mission.fixes.size());
  out_.fixes = Eigen::MatrixXd::Constant(fixes, kFixChannels, std::numeric_limits<double>::quiet_NaN());
  out_.fix_scale_m = Eigen::VectorXd::Ones(fixes);
}

void ReplayRun::complete(sim::State& state, double time_s) {
  const std::size_t row = actuators_.row_at(time_s);
  const sim::Controls now = actuators_.of_row(row);
  const auto acceleration = in_.vehicle.acceleration(body_, now, influences_);
  state.position_m = array_of(body_.position_m);
  state.euler_rad = array_of(body_.euler_rad);
  state.velocity_body_m_s = array_of(body_.velocity.head<3>());
  state.rate_rad_s = array_of(body_.velocity.tail<3>());
  state.specific_force_m_s2 = sim::specific_force(state.euler_rad, state.velocity_body_m_s, state.rate_rad_s,
                                                  array_of(acceleration.head<3>()));
  state.fins_rad = in_.actuators[row].fins_rad;
  state.rpm = 60 * now.shaft_rps;
  state.motor_current_A = in_.current_A[row];
  state.current_m_s = influences_.current_m_s;
  state.field_world_uT = in_.mission.field.north_east_down_uT;
}

void ReplayRun::begin(const CardReading& reading) {
  while (next_word_ + 1 < in_.mission.compass.size() && in_.mission.compass[next_word_].time_s < reading.time_s) {
    ++next_word_;
  }
  const CompassReading& word = in_.mission.compass[std::min(next_word_, in_.mission.compass.size() - 1)];
  const Vector3& earth_uT = in_.mission.field.north_east_down_uT;
  const double variation_rad = std::atan2(earth_uT[1], earth_uT[0]);
  const double heading_rad = word.heading_rad.value_or(heading_of(word.field_uT, word.roll_rad, word.pitch_rad));
  body_ = {};
  body_.euler_rad = {word.roll_rad, word.pitch_rad, heading_rad + variation_rad};
  body_.position_m.z() = reading.depth_m;
  body_.velocity[0] =
      sim::steady_advance_m(in_.settings) * in_.actuators[actuators_.row_at(reading.time_s)].shaft_rps;
  gyro_said_rad_s_ = about_axes(reading.gyro_rad_s);
  gyro_error_rad_s_ = gyro_error_at_rest_rad_s_;
  body_.velocity.tail<3>() = base::vector_of(gyro_said_rad_s_) - base::vector_of(gyro_error_rad_s_);
  if (!in_.electronics_C.empty()) {
    instruments_.set_electronics(in_.electronics_C[std::min(next_word_, in_.electronics_C.size() - 1)]);
  }
  instruments_.restart();
  last_fix_s_.reset();
  variance_m2_ = 0;
}

void ReplayRun::step(double from_s, double until_s, const Vector3& gyro_rad_s) {
  const double step_s = until_s - from_s;
  influences_ = {};
  effects_.influence(from_s, influences_);
  const Eigen::Vector3d euler = body_.euler_rad;
  const Eigen::Vector3d rate = base::vector_of(gyro_rad_s);
  const int parts = std::max(1, static_cast<int>(std::ceil(step_s / kLongestPart_s)));
  const double part_s = step_s / parts;
  for (int i = 0; i < parts; ++i) {
    const double at_s = from_s + i * part_s;
    body_ = in_.vehicle.midpoint_step(body_, actuators_.mean(at_s, at_s + part_s / 2),
                                      actuators_.mean(at_s, at_s + part_s), influences_, part_s);
  }
  const Eigen::Vector3d middle = euler + step_s / 2 * euler_rates(euler, rate);
  body_.euler_rad = euler + step_s * euler_rates(middle, rate);
  distance_m_ += step_s * body_.velocity.head<3>().norm();
}

void ReplayRun::carry(const CardReading& to) {
  const double from_s = states_.newest_s();
  const double span_s = to.time_s - from_s;
  const Vector3 said = about_axes(to.gyro_rad_s);
  Vector3 rate{};
  for (std::size_t i = 0; i < 3; ++i) rate[i] = (gyro_said_rad_s_[i] + said[i]) / 2 - gyro_error_rad_s_[i];
  gyro_said_rad_s_ = said;
  const int steps = std::max(1, static_cast<int>(std::ceil(span_s / kLongestStep_s)));
  for (int i = 0; i < steps; ++i) {
    // Across a gap the gyro readings at its two ends do not describe the motion in between, so the rates are
    // those of the vehicle model.
    if (steps > 3) rate = array_of(body_.velocity.tail<3>());
    step(from_s + span_s * i / steps, from_s + span_s * (i + 1) / steps, rate);
  }
}

std::optional<Eigen::Index> ReplayRun::interval_of(double time_s) const {
  if (time_s < in_.begin_s) return std::nullopt;
  const auto row = static_cast<Eigen::Index>((time_s - in_.begin_s) / kInterval_s);
  return row < in_.intervals ? std::optional(row) : std::nullopt;
}

void ReplayRun::add(std::optional<Eigen::Index> interval, Channel channel, double innovation) {
  if (!interval || !std::isfinite(innovation)) return;
  sums_(*interval, channel) += innovation;
  ++counts_(*interval, channel);
}

void ReplayRun::take_card(const CardReading& reading) {
  const double delay_s = effects_.delays(reading.time_s).card_s;
  const sim::State& now = states_.predicted();
  const auto said =
      instruments_.card(reading.time_s, delay_s > 0 ? states_.corrected_at(reading.time_s - delay_s) : now);
  const auto interval = interval_of(reading.time_s);
  std::array<double, 4> missed{};
  for (std::size_t i = 0; i < 4; ++i) missed[i] = reading.gyro_rad_s[i] - said.gyro_rad_s[i];
  add(interval, gyro_roll, missed[0]);
  add(interval, gyro_pitch, missed[2]);
  add(interval, gyro_yaw_a, missed[1]);
  add(interval, gyro_yaw_b, missed[3]);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    add(interval, static_cast<Channel>(force_x + i), reading.force_m_s2[k] - said.force_m_s2[k]);
  }
  add(interval, depth, reading.depth_m - said.depth_m);

  const auto& rate = now.rate_rad_s;
  gyro_error_rad_s_ = {said.gyro_rad_s[0] - rate[0], said.gyro_rad_s[2] - rate[1],
                       (said.gyro_rad_s[1] + said.gyro_rad_s[3]) / 2 - rate[2]};
  body_.velocity[3] += kRateGain * missed[0];
  body_.velocity[4] += kRateGain * missed[2];
  body_.velocity[5] += kRateGain * (missed[1] + missed[3]) / 2;
  body_.position_m.z() += kDepthGain * (reading.depth_m - said.depth_m);
}

void ReplayRun::take_word(const CompassReading& reading, const sim::State& state) {
  const auto said = instruments_.word(reading.time_s, state);
  const double heading_missed = base::wrapped(
      reading.heading_rad.value_or(heading_of(reading.field_uT, reading.roll_rad, reading.pitch_rad)) -
      heading_of(said.field_uT, said.tilt.roll_rad, said.tilt.pitch_rad));
  const double roll_missed = reading.roll_rad - said.tilt.roll_rad;
  const double pitch_missed = reading.pitch_rad - said.tilt.pitch_rad;
  const auto interval = interval_of(reading.time_s + in_.compass_shift_s);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    add(interval, static_cast<Channel>(field_x + i), reading.field_uT[k] - said.field_uT[k]);
  }
  add(interval, tilt_roll, roll_missed);
  add(interval, tilt_pitch, pitch_missed);
  add(interval, heading, heading_missed);
  body_.euler_rad +=
      Eigen::Vector3d{kTiltGain * roll_missed, kTiltGain * pitch_missed, kHeadingGain * heading_missed};
}

void ReplayRun::take_words(double until_s) {
  const auto& words = in_.mission.compass;
  for (; next_word_ < words.size() && words[next_word_].time_s <= until_s; ++next_word_) {
    instruments_.set_electronics(in_.electronics_C[next_word_]);
    take_word(words[next_word_], states_.filtered_at(words[next_word_].time_s));
  }
}

void ReplayRun::take_fixes(double until_s) {
  const auto& fixes = in_.mission.fixes;
  for (; next_fix_ < fixes.size() && fixes[next_fix_].time_s <= until_s; ++next_fix_) take_fix(next_fix_);
}

void ReplayRun::take_fix(std::size_t index) {
  const FixReading& fix = in_.mission.fixes[index];
  const double time_s = fix.time_s - effects_.delays(fix.time_s).gps_s;
  const auto antenna = instruments_.antenna(time_s, states_.filtered_at(time_s), offset_m_);

  const devices::GpsModel& gps = in_.mission.instruments.gps;
  const double degraded = gps.noise_factor(fix.number);
  const double fix_variance_m2 = gps.position_noise_m * gps.position_noise_m * degraded * degraded;
  const auto row = static_cast<Eigen::Index>(index);
  const double since_s = last_fix_s_ ? fix.time_s - *last_fix_s_ : 0;
  std::array<double, 2> missed_m{};
  for (std::size_t i = 0; i < 2; ++i) missed_m[i] = fix.position_m[i] - antenna.position_m[i];
  if (!last_fix_s_) {
    for (std::size_t i = 0; i < 2; ++i) offset_m_[i] += missed_m[i];
    variance_m2_ = fix_variance_m2;
  } else {
    variance_m2_ += kDriftVariance_m2_s * since_s;
    const double together_m2 = variance_m2_ + fix_variance_m2;
    out_.fix_scale_m[row] = std::sqrt(together_m2);
    if (since_s > kSubmerged_s) {
      out_.resurfacings.push_back(
          {fix.time_s, distance_m_ - distance_at_fix_m_, std::hypot(missed_m[0], missed_m[1])});
    }
    for (std::size_t i = 0; i < 2; ++i) {
      out_.fixes(row, static_cast<Eigen::Index>(fix_north + static_cast<int>(i))) =
          missed_m[i] / out_.fix_scale_m[row];
      offset_m_[i] += variance_m2_ / together_m2 * missed_m[i];
    }
    variance_m2_ *= fix_variance_m2 / together_m2;
  }
  if (fix.velocity_m_s) {
    for (std::size_t i = 0; i < 2; ++i) {
      out_.fixes(row, static_cast<Eigen::Index>(velocity_north + static_cast<int>(i))) =
          ((*fix.velocity_m_s)[i] - antenna.velocity_m_s[i]) / degraded;
    }
  }
  last_fix_s_ = fix.time_s;
  distance_at_fix_m_ = distance_m_;
}

void ReplayRun::write_course(const CardReading& reading, Trajectory10Hz& course) const {
  const auto interval = interval_of(reading.time_s);
  if (!interval || *interval < static_cast<Eigen::Index>(course.time_s.size())) return;
  const sim::State& state = states_.predicted();
  const auto& fins = state.fins_rad;
  while (static_cast<Eigen::Index>(course.time_s.size()) <= *interval) {
    course.time_s.push_back(in_.begin_s + (static_cast<double>(course.time_s.size()) + 0.5) * kInterval_s);
    course.heading_rad.push_back(state.euler_rad[2]);
    course.roll_rad.push_back(state.euler_rad[0]);
    course.pitch_rad.push_back(state.euler_rad[1]);
    course.yaw_rate_rad_s.push_back(state.rate_rad_s[2]);
    course.pitch_rate_rad_s.push_back(state.rate_rad_s[1]);
    course.depth_m.push_back(state.position_m[2]);
    course.surge_m_s.push_back(state.velocity_body_m_s[0]);
    course.current_A.push_back(state.motor_current_A);
    course.temperature_rise_C.push_back(instruments_.electronics_C() - base::reference::kTemperature_C);
    // The mixing of the card's interface document, section 4, undone.
    course.rudder_rad.push_back((-2 * fins[0] + fins[1] + fins[2]) / 3);
    course.elevator_rad.push_back((fins[1] - fins[2]) / std::numbers::sqrt3);
    course.shaft_rps.push_back(state.rpm / 60);
  }
}

Innovations ReplayRun::innovations(Trajectory10Hz* course) {
  if (course != nullptr) course->instruments = in_.mission.instruments;
  for (const CardReading& reading : in_.mission.card) {
    if (reading.time_s < in_.begin_s) continue;
    if (states_.empty() || reading.time_s - states_.newest_s() > kRestart_s) {
      begin(reading);
    } else {
      carry(reading);
    }
    sim::State predicted;
    complete(predicted, reading.time_s);
    states_.predict(reading.time_s, predicted);
    take_words(reading.time_s);
    take_fixes(reading.time_s);
    take_card(reading);
    instruments_.feel(reading.time_s, predicted);
    states_.correct(array_of(body_.euler_rad), array_of(body_.position_m), array_of(body_.velocity.tail<3>()));
    if (course != nullptr) write_course(reading, *course);
  }
  // 0 / 0 gives NaN where nothing was measured.
  out_.grid = (sums_.array() / counts_.cast<double>().array()).matrix();
  return std::move(out_);
}

}  // namespace navcal::gap

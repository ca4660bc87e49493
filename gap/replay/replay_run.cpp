// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/replay_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "autopilot/shaft_speed.h"
#include "base/angles.h"
#include "base/reference_instruments.h"
#include "base/vectors.h"
#include "calib/correction.h"
#include "gap/replay/estimator_gains.h"
#include "sim/rotation.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::gap {
namespace {

// Gains of the estimator, for each reading or frame. Set by a study of this vehicle.
constexpr double kHeadingGain = 0.02, kTiltGain = 0.05, kRateGain = 0.15;
/// In the place of a silent compass: share by which one frame's specific force corrects roll and pitch, and one
/// fix's course over ground the heading.
constexpr double kLevelGain = 0.01, kCourseGain = 0.1;
/// Time over which the first attitude is levelled by specific force.
constexpr double kLevelled_s = 1;
/// Slower than this over ground, the course says nothing of the heading.
constexpr double kLeastCourse_m_s = 0.4;
constexpr double kDriftVariance_m2_s = 0.02;
/// After a longer silence the card has been off, and the estimator begins anew.
constexpr double kRestart_s = 5;
constexpr double kLongestStep_s = 0.06;
constexpr double kSubmerged_s = 10;

Eigen::Vector3d euler_rates(const Eigen::Vector3d& euler_rad, const Eigen::Vector3d& rate_rad_s) {
  const double cf = std::cos(euler_rad[0]), sf = std::sin(euler_rad[0]);
  const double yaw = (sf * rate_rad_s[1] + cf * rate_rad_s[2]) / std::cos(euler_rad[1]);
  return {rate_rad_s[0] + std::sin(euler_rad[1]) * yaw, cf * rate_rad_s[1] - sf * rate_rad_s[2], yaw};
}

/// Mean of the two gyros about z, or what one of them says where the other is silent.
double about_z(double a, double b) { return std::isnan(b) ? a : std::isnan(a) ? b : (a + b) / 2; }

/// Body rates about x, y and z from the four gyros; the two about z are averaged.
Vector3 about_axes(const std::array<double, 4>& gyros) {
  return {gyros[0], gyros[2], about_z(gyros[1], gyros[3])};
}

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0; }

/// What is predicted of gyros, without those that are silent.
std::array<double, 4> of_speaking(std::array<double, 4> said, const std::array<double, 4>& measured) {
  for (std::size_t i = 0; i < said.size(); ++i) {
    if (std::isnan(measured[i])) said[i] = measured[i];
  }
  return said;
}

/// Magnetic heading from the compass's own field and tilt; NaN without a field.
double heading_of(const Vector3& field, double roll_rad, double pitch_rad) {
  if (std::isnan(field[0])) return field[0];
  return calib::levelled_heading(base::vector_of(field), roll_rad, pitch_rad);
}

}  // namespace

ReplayRun::ReplayRun(const ReplayInput& input, const Model& model)
    : in_(input), effects_(model.effects), actuators_(input.actuators, effects_),
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
  sim::set_motion(state, body_, in_.vehicle.acceleration(body_, in_.vehicle.hold(now.values(), influences_)));
  state.fins_rad = in_.actuators[row].fins_rad;
  state.rpm = 60 * now.shaft_rps;
  state.motor_current_A = in_.current_A[row];
  state.current_m_s = influences_.current_m_s;
  state.field_world_uT = in_.mission.field.north_east_down_uT;
}

Eigen::Vector3d ReplayRun::first_attitude(const CardReading& reading) const {
  const Mission& mission = in_.mission;
  const Vector3& earth_uT = mission.field.north_east_down_uT;
  const double variation_rad = std::atan2(earth_uT[1], earth_uT[0]);
  const bool levelled = mission.is_silent(Quantity::tilt, reading.time_s);
  const CompassReading* const word =
      mission.compass.empty() ? nullptr : &mission.compass[std::min(next_word_, mission.compass.size() - 1)];
  double roll_rad = 0, pitch_rad = 0;
  if (!levelled && word != nullptr && std::isfinite(word->roll_rad)) {
    roll_rad = word->roll_rad;
    pitch_rad = word->pitch_rad;
  } else {
    Eigen::Vector3d force_m_s2 = Eigen::Vector3d::Zero();
    for (const CardReading& frame : mission.card) {
      const bool is_near = frame.time_s >= reading.time_s && frame.time_s < reading.time_s + kLevelled_s;
      if (is_near && std::isfinite(frame.force_m_s2[0])) force_m_s2 += base::vector_of(frame.force_m_s2);
    }
    if (force_m_s2.norm() > 0) {
      roll_rad = std::atan2(-force_m_s2.y(), -force_m_s2.z());
      pitch_rad = std::atan2(force_m_s2.x(), std::hypot(force_m_s2.y(), force_m_s2.z()));
    }
  }
  if (word != nullptr && !mission.is_silent(Quantity::heading, reading.time_s)) {
    const double heading_rad = word->heading_rad.value_or(heading_of(word->field_uT, roll_rad, pitch_rad));
    if (std::isfinite(heading_rad)) return {roll_rad, pitch_rad, heading_rad + variation_rad};
  }
  const auto fix = std::ranges::find_if(
      mission.fixes, [&](const FixReading& each) { return each.time_s >= reading.time_s && each.velocity_m_s; });
  if (fix == mission.fixes.end()) return {roll_rad, pitch_rad, 0};
  return {roll_rad, pitch_rad, std::atan2((*fix->velocity_m_s)[1], (*fix->velocity_m_s)[0])};
}

void ReplayRun::begin(const CardReading& reading) {
  while (next_word_ + 1 < in_.mission.compass.size() && in_.mission.compass[next_word_].time_s < reading.time_s) {
    ++next_word_;
  }
  body_ = {};
  body_.euler_rad = first_attitude(reading);
  has_heading_ = !in_.mission.is_silent(Quantity::heading, reading.time_s);
  body_.position_m.z() = finite_or_zero(reading.depth_m);
  body_.velocity[0] =
      autopilot::surge_for(in_.settings, 1) * in_.actuators[actuators_.row_at(reading.time_s)].shaft_rps;
  gyro_said_rad_s_ = about_axes(reading.gyro_rad_s);
  gyro_error_rad_s_ = gyro_error_at_rest_rad_s_;
  for (std::size_t i = 0; i < 3; ++i) {
    body_.velocity[static_cast<Eigen::Index>(3 + i)] = finite_or_zero(gyro_said_rad_s_[i] - gyro_error_rad_s_[i]);
  }
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
  const int parts = std::max(1, static_cast<int>(std::ceil(step_s / in_.longest_part_s)));
  const double part_s = step_s / parts;
  for (int i = 0; i < parts; ++i) {
    const double at_s = from_s + i * part_s;
    body_ = in_.vehicle.midpoint_step(body_, actuators_.mean(at_s, at_s + part_s / 2).values(),
                                      actuators_.mean(at_s, at_s + part_s).values(), part_s, influences_);
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
  const bool measured = std::isfinite(rate[0]) && std::isfinite(rate[1]) && std::isfinite(rate[2]);
  const int steps = std::max(1, static_cast<int>(std::ceil(span_s / kLongestStep_s)));
  for (int i = 0; i < steps; ++i) {
    // Across a gap the gyro readings at its two ends do not describe the motion in between, so the rates are
    // those of the vehicle model.
    if (steps > 3 || !measured) rate = sim::array_of(body_.velocity.tail<3>());
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
  const Vector3 said_rad_s = about_axes(of_speaking(said.gyro_rad_s, reading.gyro_rad_s));
  for (std::size_t i = 0; i < 3; ++i) gyro_error_rad_s_[i] = said_rad_s[i] - rate[i];
  body_.velocity[3] += kRateGain * finite_or_zero(missed[0]);
  body_.velocity[4] += kRateGain * finite_or_zero(missed[2]);
  body_.velocity[5] += kRateGain * finite_or_zero(about_z(missed[1], missed[3]));
  body_.position_m.z() += kDepthGain * finite_or_zero(reading.depth_m - said.depth_m);
  if (in_.mission.is_silent(Quantity::tilt, reading.time_s)) level_by(reading, said);
}

void ReplayRun::level_by(const CardReading& reading, const PredictedInstruments::Card& said) {
  body_.euler_rad[0] -=
      kLevelGain * finite_or_zero(reading.force_m_s2[1] - said.force_m_s2[1]) / sim::kGravity_m_s2;
  body_.euler_rad[1] +=
      kLevelGain * finite_or_zero(reading.force_m_s2[0] - said.force_m_s2[0]) / sim::kGravity_m_s2;
}

void ReplayRun::take_word(const CompassReading& reading, const sim::State& state) {
  const auto said = instruments_.word(reading.time_s, state);
  // A magnetometer without an inclinometer is levelled by the estimate.
  const bool has_tilt = std::isfinite(reading.roll_rad);
  const double roll_rad = has_tilt ? reading.roll_rad : said.tilt.roll_rad;
  const double pitch_rad = has_tilt ? reading.pitch_rad : said.tilt.pitch_rad;
  const double heading_missed =
      base::wrapped(reading.heading_rad.value_or(heading_of(reading.field_uT, roll_rad, pitch_rad)) -
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
      Eigen::Vector3d{kTiltGain * finite_or_zero(roll_missed), kTiltGain * finite_or_zero(pitch_missed),
                      kHeadingGain * finite_or_zero(heading_missed)};
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
    std::array<double, 2> missed_m_s{};
    for (std::size_t i = 0; i < 2; ++i) missed_m_s[i] = (*fix.velocity_m_s)[i] - antenna.velocity_m_s[i];
    const bool is_start = steer_by(fix, missed_m_s, degraded);
    for (std::size_t i = 0; i < 2 && !is_start; ++i) {
      out_.fixes(row, static_cast<Eigen::Index>(velocity_north + static_cast<int>(i))) = missed_m_s[i] / degraded;
    }
  }
  last_fix_s_ = fix.time_s;
  distance_at_fix_m_ = distance_m_;
}

bool ReplayRun::steer_by(const FixReading& fix, const std::array<double, 2>& missed_m_s, double degraded) {
  const auto& [north_m_s, east_m_s] = *fix.velocity_m_s;
  const double speed_m_s = std::hypot(north_m_s, east_m_s);
  if (!in_.mission.is_silent(Quantity::heading, fix.time_s) || speed_m_s < kLeastCourse_m_s) return false;
  double& heading_rad = body_.euler_rad[2];
  if (!has_heading_) {
    has_heading_ = true;
    heading_rad = std::atan2(east_m_s, north_m_s);
    return true;
  }
  const double across_m_s = std::cos(heading_rad) * missed_m_s[1] - std::sin(heading_rad) * missed_m_s[0];
  heading_rad += kCourseGain / degraded * across_m_s / speed_m_s;
  return false;
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
    states_.correct(sim::array_of(body_.euler_rad), sim::array_of(body_.position_m),
                    sim::array_of(body_.velocity.tail<3>()));
    if (course != nullptr) write_course(reading, *course);
  }
  // 0 / 0 gives NaN where nothing was measured.
  out_.grid = (sums_.array() / counts_.cast<double>().array()).matrix();
  return std::move(out_);
}

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/gps_calibrators.h"

#include <cmath>
#include <numbers>

namespace navcal::calib {
namespace {

/// A fix taken in a turn, or without a heading so close before it, tells nothing of A.
constexpr double kStraight_rad_s = 0.05;
constexpr double kHeadingAge_s = 0.5;
constexpr double kLeastSpeed_m_s = 0.5;

double square_of_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2 * std::numbers::pi);
  return wrapped * wrapped;
}

WaterSpeed::Parameters speed_parameters(const SuiteOptions& options) {
  WaterSpeed::Parameters parameters;
  parameters.advance_m = options.advance_m;
  return parameters;
}

Misalignment::Parameters misalignment_parameters(const SuiteOptions& options) {
  Misalignment::Parameters parameters;
  parameters.run.position_std_m = options.position_noise_m;
  parameters.current_std_m_s = options.current_m_s;
  return parameters;
}

GpsCompass::Parameters gps_parameters(const SuiteOptions& options) {
  GpsCompass::Parameters parameters;
  parameters.declination_rad = options.local_field.declination_rad;
  parameters.current_std_m_s = options.current_m_s;
  parameters.summary.velocity_std_m_s = options.velocity_noise_m_s;
  parameters.summary.position_std_m = options.position_noise_m;
  return parameters;
}

/// The active correction without the misalignment A.
Correction without_offset(const Correction& in_force) {
  Correction rest = in_force;
  rest.misalignment_rad.reset();
  if (rest.gps_compass) rest.gps_compass = rest.gps_compass->without_offset();
  return rest;
}

}  // namespace

GpsCalibrators::GpsCalibrators(const SuiteOptions& options)
    : options_(options), speed_(speed_parameters(options)), misalignment_(misalignment_parameters(options)),
      gps_compass_(gps_parameters(options)) {}

WaterTrackReading GpsCalibrators::track_of(const CompassReading& reading, double turn_rate_rad_s) const {
  return {.time_s = reading.time_s,
          .heading_rad = reading.heading_rad.value_or(std::nan("")),
          .turn_rate_rad_s = turn_rate_rad_s,
          .speed_m_s = speed_.at(reading.time_s).value_or(0)};
}

void GpsCalibrators::update(const CompassReading& reading, const WaterTrackReading& track,
                            const Correction& in_force) {
  const auto heading_rad = best_heading(without_offset(in_force), reading);
  if (!heading_rad) return;
  heading_rad_ = *heading_rad + options_.local_field.declination_rad;
  heading_s_ = reading.time_s;
  turn_rate_rad_s_ = track.turn_rate_rad_s;
  misalignment_.update_heading(reading.time_s, *heading_rad_);
  if (reading.heading_rad && options_.advance_m > 0 && speed_.at(reading.time_s)) gps_compass_.update(track);
}

void GpsCalibrators::update(const MotorReading& motor) {
  if (options_.advance_m > 0) speed_.update(motor);
}

void GpsCalibrators::update(const GroundReading& ground, const Correction& in_force) {
  judge(ground, in_force);
  misalignment_.update(ground);
  GroundReading in_time = ground;
  in_time.time_s -= in_force.course_delay_s.value_or(0);
  gps_compass_.update(in_time);
}

void GpsCalibrators::judge(const GroundReading& ground, const Correction& in_force) {
  const bool usable = ground.course_rad && ground.speed_m_s >= kLeastSpeed_m_s && heading_rad_ &&
                      ground.time_s - heading_s_ <= kHeadingAge_s && std::abs(turn_rate_rad_s_) <= kStraight_rad_s;
  if (!usable) return;
  if (fixes_ == 0) {
    const auto estimate = misalignment_.estimate();
    if (!estimate) return;
    offset_rad_ = estimate->offset_rad;
    before_ = in_force_ = estimate_ = 0;
  }
  const double residual_rad = *heading_rad_ - *ground.course_rad;
  before_ += square_of_angle(residual_rad);
  in_force_ += square_of_angle(residual_rad - in_force.offset_rad().value_or(0));
  estimate_ += square_of_angle(residual_rad - offset_rad_);
  if (++fixes_ < kFixes) return;
  comparison_.add(before_ / kFixes, in_force_ / kFixes, estimate_ / kFixes);
  fixes_ = 0;
}

void GpsCalibrators::set_declination(double declination_rad) {
  options_.local_field.declination_rad = declination_rad;
  gps_compass_.set_declination(declination_rad);
}

void GpsCalibrators::start_compass() { gps_compass_ = GpsCompass(gps_parameters(options_)); }

void GpsCalibrators::start_misalignment() {
  misalignment_ = Misalignment(misalignment_parameters(options_));
  comparison_ = {};
  fixes_ = 0;
}

void GpsCalibrators::archive(Archive& archive) {
  archive.tag("surface_calibrators 1");
  archive(speed_, misalignment_, gps_compass_, heading_rad_, heading_s_, turn_rate_rad_s_, offset_rad_, fixes_,
          before_, in_force_, estimate_, comparison_);
}

}  // namespace navcal::calib

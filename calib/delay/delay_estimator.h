// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/reference_instruments.h"
#include "calib/archive.h"
#include "calib/delay/delay.h"
#include "calib/delay/delay_course.h"
#include "calib/delay/delay_field.h"
#include "calib/delay/delay_heading.h"
#include "calib/judgement.h"
#include "calib/turn/turn_integrator.h"

namespace navcal::calib {

/// Model: an instrument that is tau seconds late shows q(t - tau) = q(t) - tau q'(t): the delay is the regression
/// of its residual on the rate. Of the compass against the gyro, by its field (FieldDelay) and by its heading
/// (HeadingDelay); of the GPS course against the heading (CourseDelay). All relative to the stamps as given: what
/// is configured already is not in it.
class DelayEstimator {
 public:
  struct Parameters {
    HeadingDelay::Parameters heading;
    FieldDelay::Parameters field;
    CourseDelay::Parameters course;
    double tilt_lag_s = base::reference::kTiltLag_s;  ///< of the compass's inclinometer
    double tilt_noise_rad = base::reference::kReckonedTiltNoise_rad;
    double level_std_s = 0.003;  ///< error of the heading by tilt and vertical hard iron (measured: bench delay)
    double accepted_std_s = 0.002;  ///< compass
    double accepted_course_std_s = 0.15;
  };

  DelayEstimator() : DelayEstimator(Parameters{}) {}
  explicit DelayEstimator(const Parameters& parameters);

  void update(const RateReading& rate);
  void update(const CompassReading& compass);
  void update(const WaterTrackReading& track) { course_.update(track); }
  void update(const GroundReading& ground) { course_.update(ground); }

  /// Delay of the compass against the gyro: by the field where there are field readings, else by the heading.
  /// Its standard deviation contains that of both instruments' stamps.
  [[nodiscard]] Delay compass() const;
  [[nodiscard]] const HeadingDelay& heading() const { return heading_; }
  [[nodiscard]] const FieldDelay& field() const { return field_; }
  [[nodiscard]] const CourseDelay& course() const { return course_; }
  [[nodiscard]] Judgement compass_judgement() const;
  [[nodiscard]] Judgement course_judgement() const;
  void archive(Archive& archive);

 private:
  void take_steps();

  Parameters parameters_;
  TurnIntegrator turns_;
  HeadingDelay heading_;
  FieldDelay field_;
  CourseDelay course_;
  double compass_std_s_ = 0, rate_std_s_ = 0;  ///< of the newest stamps
};

}  // namespace navcal::calib

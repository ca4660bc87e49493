// SPDX-License-Identifier: Apache-2.0
#include "calib/delay/delay_estimator.h"

#include <cmath>

namespace navcal::calib {
namespace {

constexpr double kLeastSpread_rad_s = 0.05;

Judgement judge(const Delay& delay, double accepted_std_s) {
  Judgement judgement;
  judgement.samples = delay.readings;
  // More readings do not reduce the part of the uncertainty that the stamps state themselves.
  const double by_noise_s = std::sqrt(delay.std_s * delay.std_s - delay.stamps_std_s * delay.stamps_std_s);
  judgement.accepted = by_noise_s <= accepted_std_s;
  judgement.coverage = judgement.accepted ? 1 : accepted_std_s / by_noise_s;
  if (judgement.accepted) return judgement;
  judgement.reason = delay.rate_spread_rad_s < kLeastSpread_rad_s
                         ? "the rate of turn has hardly changed: a delay does not show"
                         : "the delay is not known well enough yet";
  judgement.manoeuvre = "turn to both sides, beginning and ending the turns briskly, for a minute";
  return judgement;
}

}  // namespace

DelayEstimator::DelayEstimator(const Parameters& parameters)
    : parameters_(parameters), turns_([&] {
        TurnIntegrator::Parameters turns;
        turns.tilt_lag_s = parameters.tilt_lag_s;
        turns.tilt_noise_rad = parameters.tilt_noise_rad;
        turns.levels_heading = false;  // HeadingDelay finds what the lag does to the heading
        return turns;
      }()),
      heading_([&] {
        auto heading = parameters.heading;
        heading.level_std_s = parameters.level_std_s;
        return HeadingDelay(heading);
      }()),
      field_(parameters.field), course_(parameters.course) {}

void DelayEstimator::update(const RateReading& rate) {
  turns_.update(rate);
  field_.update(rate);
  rate_std_s_ = rate.time_std_s;
  take_steps();
}

void DelayEstimator::update(const CompassReading& compass) {
  compass_std_s_ = compass.time_std_s;
  turns_.update(compass);
  field_.update(compass);
  take_steps();
}

void DelayEstimator::take_steps() {
  while (const auto step = turns_.next()) {
    // A first-order lag: what is shown changes by the difference from the tilt over the lag.
    const double per_s = parameters_.tilt_lag_s > 0 ? 1 / parameters_.tilt_lag_s : 0;
    heading_.update(*step, {step->roll_lag_rad * per_s, step->pitch_lag_rad * per_s});
  }
}

Delay DelayEstimator::compass() const {
  const Delay by_heading = heading_.estimate(), by_field = field_.estimate();
  // The heading has gone through a level that is late itself, and soft iron bends it as a delay would.
  Delay delay = by_field.readings > 0 ? by_field : by_heading;
  // The delay is against the gyro's stamps, so where either instrument's stamps are off, it is off as much.
  delay.stamps_std_s = std::hypot(compass_std_s_, rate_std_s_);
  delay.std_s = std::hypot(delay.std_s, delay.stamps_std_s);
  return delay;
}

Judgement DelayEstimator::compass_judgement() const { return judge(compass(), parameters_.accepted_std_s); }
Judgement DelayEstimator::course_judgement() const {
  return judge(course_.estimate(), parameters_.accepted_course_std_s);
}

void DelayEstimator::archive(Archive& archive) {
  archive.tag("delay_estimator 2");
  archive(turns_, heading_, field_, course_, compass_std_s_, rate_std_s_);
}

}  // namespace navcal::calib

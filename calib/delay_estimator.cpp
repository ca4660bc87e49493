#include "calib/delay_estimator.h"

#include <cmath>

namespace navcal::calib {
namespace {

constexpr double kLeastSpread_rad_s = 0.05;

Judgement judge(const Delay& delay, double accepted_std_s) {
  Judgement judgement;
  judgement.samples = delay.readings;
  judgement.accepted = delay.std_s <= accepted_std_s;
  judgement.coverage = judgement.accepted ? 1 : accepted_std_s / delay.std_s;
  if (judgement.accepted) return judgement;
  judgement.reason = delay.rate_spread_rad_s < kLeastSpread_rad_s
                         ? "the rate of turn has hardly changed: a delay does not show"
                         : "the delay is not known well enough yet";
  judgement.manoeuvre = "turn to both sides, beginning and ending the turns briskly, for a minute";
  return judgement;
}

}  // namespace

DelayEstimator::DelayEstimator(const Parameters& parameters)
    : parameters_(parameters),
      turns_([&] {
        TurnIntegrator::Parameters turns;
        turns.tilt_lag_s = parameters.tilt_lag_s;
        return turns;
      }()),
      heading_([&] {
        auto heading = parameters.heading;
        heading.level_std_s = parameters.level_std_s;
        return HeadingDelay(heading);
      }()),
      field_(parameters.field),
      course_(parameters.course) {}

void DelayEstimator::update(const RateReading& rate) {
  turns_.update(rate);
  field_.update(rate);
  if (!rate.saturated && std::isfinite(rate.time_s) && rate.rate_rad_s.allFinite()) follow_tilt(rate);
  take_steps();
}

/// The slope of the tilt through the lag of the inclinometer, by pitch and roll gyro.
void DelayEstimator::follow_tilt(const RateReading& rate) {
  const double duration_s = rate.time_s - tilt_time_s_;
  tilt_time_s_ = rate.time_s;
  const double sine = std::sin(roll_rad_), cosine = std::cos(roll_rad_);
  const Eigen::Vector3d& omega = rate.rate_rad_s;
  const double roll_rad_s = omega.x() + (omega.y() * sine + omega.z() * cosine) * std::tan(pitch_rad_);
  const double pitch_rad_s = omega.y() * cosine - omega.z() * sine;
  if (duration_s <= 0 || parameters_.tilt_lag_s <= 0) return;
  const double share = -std::expm1(-duration_s / parameters_.tilt_lag_s);
  tilt_.roll_rad_s += share * (roll_rad_s - tilt_.roll_rad_s);
  tilt_.pitch_rad_s += share * (pitch_rad_s - tilt_.pitch_rad_s);
}

void DelayEstimator::update(const CompassReading& compass) {
  if (!compass.faulty && compass.roll_rad && compass.pitch_rad && std::isfinite(*compass.roll_rad) &&
      std::abs(*compass.pitch_rad) < 1) {
    roll_rad_ = *compass.roll_rad;
    pitch_rad_ = *compass.pitch_rad;
  }
  turns_.update(compass);
  field_.update(compass);
  take_steps();
}

void DelayEstimator::take_steps() {
  while (const auto step = turns_.next()) heading_.update(*step, tilt_);
}

Delay DelayEstimator::compass() const {
  const Delay by_heading = heading_.estimate(), by_field = field_.estimate();
  // The heading has gone through a level that is late itself: as good in numbers, it still is the worse witness.
  return by_field.std_s < 3 * by_heading.std_s ? by_field : by_heading;
}

Judgement DelayEstimator::compass_judgement() const { return judge(compass(), parameters_.accepted_std_s); }
Judgement DelayEstimator::course_judgement() const {
  return judge(course_.estimate(), parameters_.accepted_course_std_s);
}

void DelayEstimator::archive(Archive& archive) {
  archive.tag("delay_estimator 1");
  archive(turns_, heading_, field_, course_);
  archive(tilt_time_s_, roll_rad_, pitch_rad_, tilt_.roll_rad_s, tilt_.pitch_rad_s);
}

}  // namespace navcal::calib

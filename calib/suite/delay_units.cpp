// SPDX-License-Identifier: Apache-2.0
// The delays of compass and GPS course. Both are estimated by DelayEstimator, which compass_delay feeds and
// archives.
#include <cmath>

#include "calib/suite/calibrator_unit.h"
#include "calib/suite/shared_estimators.h"

namespace navcal::calib {
namespace {

std::optional<double> seconds_of(const Delay& delay) {
  return std::isfinite(delay.std_s) ? std::optional(delay.delay_s) : std::nullopt;
}

std::vector<Quantity> quantities_of_delay(const Delay& delay) {
  if (!std::isfinite(delay.std_s)) return {};
  return {{"delay_s", delay.delay_s, delay.std_s}};
}

class CompassDelayUnit : public CalibratorUnit {
 public:
  CompassDelayUnit(const SuiteOptions& options, SharedEstimators& shared)
      : options_(options), delays_(shared.delays) {}
  void update_compass(const CompassReading& reading) override { delays_.update(reading); }
  void update_rate(const RateReading& reading) override { delays_.update(reading); }
  void update_learnt(const LearntReading& learnt) override {
    if (learnt.reading.heading_rad) delays_.update(learnt.track);
  }
  void update_ground(const GroundReading& reading, const Correction&) override { delays_.update(reading); }
  void start() override { delays_ = DelayEstimator(delay_parameters(options_)); }
  void put_estimate(Correction& into) const override { into.compass_delay_s = seconds_of(delays_.compass()); }
  [[nodiscard]] Judgement judgement() const override { return delays_.compass_judgement(); }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    return quantities_of_delay(delays_.compass());
  }
  void archive(Archive& archive) override { archive(delays_); }

 private:
  SuiteOptions options_;
  DelayEstimator& delays_;
};

class CourseDelayUnit : public CalibratorUnit {
 public:
  CourseDelayUnit(const SuiteOptions& options, SharedEstimators& shared)
      : options_(options), delays_(shared.delays) {}
  void start() override { delays_ = DelayEstimator(delay_parameters(options_)); }
  void put_estimate(Correction& into) const override {
    into.course_delay_s = seconds_of(delays_.course().estimate());
  }
  [[nodiscard]] Judgement judgement() const override { return delays_.course_judgement(); }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    return quantities_of_delay(delays_.course().estimate());
  }
  void archive(Archive&) override {}

 private:
  SuiteOptions options_;
  DelayEstimator& delays_;
};

std::vector<NamedNumbers> values_of_delay(double delay_s) { return {{"delay_s", {delay_s}}}; }

}  // namespace

namespace calibrator_rows {
extern const CalibratorRow compass_delay, course_delay;
constinit const CalibratorRow compass_delay{
    .name = "compass_delay",
    .title = "Delay of compass",
    .needs = {.compass = true, .rate = true},
    .needs_text = "a compass and an inertial card (protocol imu-card)",
    .corrects = Corrects::time,
    .place = place_of<&Correction::compass_delay_s>(),
    .values = [](const Correction& correction) { return values_of_delay(*correction.compass_delay_s); },
    .make = make_unit<CompassDelayUnit>};
constinit const CalibratorRow course_delay{
    .name = "course_delay",
    .title = "Delay of GPS course",
    .needs = {.compass = true, .ground = true},
    .needs_text = "a compass and a GPS receiver (protocol oncore or nmea)",
    .corrects = Corrects::time,
    .place = place_of<&Correction::course_delay_s>(),
    .values = [](const Correction& correction) { return values_of_delay(*correction.course_delay_s); },
    .make = make_unit<CourseDelayUnit>};
}  // namespace calibrator_rows
}  // namespace navcal::calib

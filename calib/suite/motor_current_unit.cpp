// SPDX-License-Identifier: Apache-2.0
// The field of the motor's current.
#include "calib/suite/calibrator_unit.h"
#include "calib/suite/shared_estimators.h"

namespace navcal::calib {
namespace {

class MotorCurrentUnit : public CalibratorUnit {
 public:
  MotorCurrentUnit(const SuiteOptions&, SharedEstimators& shared) : motor_(shared.motor_current) {}
  void update_measured(const CompassReading& reading, const Correction& in_force) override {
    motor_.update(reading, in_force.motor_current.value_or(MotorCurrentCorrection{}).slope_uT_per_A);
  }
  void update_rate(const RateReading& reading) override { motor_.update(reading); }
  void update_motor(const MotorReading& reading) override { motor_.update(reading); }
  void finish() override { motor_.finish(); }
  void start() override { motor_.start(); }
  void on_in_force(Calibrator changed, const Correction&) override {
    if (changed == Calibrator::motor_current) motor_.on_change();
  }
  void put_estimate(Correction& into) const override {
    const auto estimate = motor_.estimate();
    into.motor_current = estimate ? std::optional(MotorCurrentCorrection{estimate->slope_uT_per_A}) : std::nullopt;
  }
  [[nodiscard]] Judgement judgement() const override { return motor_.judgement(); }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    const auto estimate = motor_.estimate();
    if (!estimate) return {};
    const auto& slope = estimate->slope_uT_per_A;
    const auto std = [&](Eigen::Index i) { return std_of(estimate->covariance(i, i)); };
    return {
        {"x_uT_per_A", slope.x(), std(0)}, {"y_uT_per_A", slope.y(), std(1)}, {"z_uT_per_A", slope.z(), std(2)}};
  }
  [[nodiscard]] OwnComparison comparison() const override {
    return {&motor_.comparison(), HeldOutQuantity::motor_field};
  }
  void archive(Archive& archive) override { archive(motor_); }

 private:
  MotorCurrent& motor_;
};

std::vector<NamedNumbers> values_of_motor(const MotorCurrentCorrection& motor) {
  const auto& slope = motor.slope_uT_per_A;
  return {{"slope_uT_per_A", {slope.x(), slope.y(), slope.z()}, 1}};
}

}  // namespace

namespace calibrator_rows {
extern const CalibratorRow motor_current;
constinit const CalibratorRow motor_current{
    .name = "motor_current",
    .title = "Motor current",
    .needs = {.compass = true, .rate = true, .motor = true},
    .needs_text = "a compass that gives its field, an inertial card and a motor card",
    .corrects = Corrects::field,
    .automatic = true,
    .place = place_of<&Correction::motor_current>(),
    .values = [](const Correction& correction) { return values_of_motor(*correction.motor_current); },
    .make = make_unit<MotorCurrentUnit>};
}  // namespace calibrator_rows
}  // namespace navcal::calib

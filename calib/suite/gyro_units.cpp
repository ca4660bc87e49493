// SPDX-License-Identifier: Apache-2.0
// The gyros A and B: scale and bias of each from turns, and how far they disagree.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "calib/suite/calibrator_unit.h"
#include "calib/suite/shared_estimators.h"
#include "calib/thesis/adaptive_identifier.h"

namespace navcal::calib {
namespace {

// Standard errors from which on the readings have not told more than was known before them.
constexpr double kScaleUndetermined = 1;
constexpr double kRateUndetermined_rad_s = 1;

constexpr std::array<std::string_view, 2> kRateNames{"scale", "bias_rad_s"};

std::optional<RateCorrection> rate_of(const TurnCalibrator& gyro) {
  if (!gyro.has_estimate()) return std::nullopt;
  const TurnCoefficients estimate = gyro.filter().estimate();
  return RateCorrection{estimate[kScale], estimate[kBias]};
}

std::vector<Quantity> quantities_of_gyro(const TurnCalibrator& gyro) {
  if (!gyro.has_estimate()) return {};
  const TurnCoefficients estimate = gyro.filter().estimate();
  const TurnCovariance covariance = gyro.filter().covariance();
  return {determined("scale", estimate[kScale], std_of(covariance(kScale, kScale)), kScaleUndetermined),
          determined("bias_rad_s", estimate[kBias], std_of(covariance(kBias, kBias)), kRateUndetermined_rad_s)};
}

std::vector<NamedNumbers> values_of_rate(const RateCorrection& rate) {
  return {{kRateNames[0], {rate.scale}}, {kRateNames[1], {rate.bias_rad_s}}};
}

class GyroUnit : public CalibratorUnit {
 public:
  GyroUnit(const SuiteOptions&, SharedEstimators& shared) : gyro_(shared.gyro) {}
  void update_turn(const TurnStep& step) override { gyro_.update(step); }
  void start() override { gyro_.start(); }
  void put_estimate(Correction& into) const override { into.gyro = rate_of(gyro_); }
  [[nodiscard]] Judgement judgement() const override { return gyro_.judgement(); }
  [[nodiscard]] std::vector<Quantity> quantities() const override { return quantities_of_gyro(gyro_); }
  void archive(Archive& archive) override { archive(gyro_); }

 private:
  TurnCalibrator& gyro_;
};

class GyroBUnit : public CalibratorUnit {
 public:
  GyroBUnit(const SuiteOptions& options, SharedEstimators& shared)
      : gyro_(TurnCalibrator::Subject::gyro, turn_parameters(options)), pair_(shared.gyros) {}
  void update_rate(const RateReading& reading) override { pair_.update(reading); }
  void update_turn(const TurnStep& step) override {
    if (std::isfinite(step.measured_angle_b_rad)) gyro_.update(step.with_gyro_b());
  }
  void start() override { gyro_.start(); }
  void on_in_force(Calibrator changed, const Correction& in_force) override {
    if (changed != Calibrator::gyro && changed != Calibrator::gyro_b) return;
    const auto line = [](const std::optional<RateCorrection>& rate) {
      return GyroPair::Line{rate.value_or(RateCorrection{}).scale, rate.value_or(RateCorrection{}).bias_rad_s};
    };
    pair_.set_calibration(line(in_force.gyro), line(in_force.gyro_b));
  }
  void put_estimate(Correction& into) const override { into.gyro_b = rate_of(gyro_); }
  [[nodiscard]] Judgement judgement() const override {
    Judgement judgement = gyro_.judgement();
    if (judgement.accepted || pair_.has_readings()) return judgement;
    judgement.reason = "no reading of a second yaw gyro so far";
    judgement.manoeuvre.clear();
    return judgement;
  }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    auto quantities = quantities_of_gyro(gyro_);
    // The disagreement is that of the gyros with their active corrections.
    if (const auto disagreement = pair_.disagreement_rad_s())
      quantities.push_back({"disagreement_rad_s", *disagreement, pair_.standard_error_rad_s()});
    return quantities;
  }
  void archive(Archive& archive) override { archive(gyro_); }

 private:
  TurnCalibrator gyro_;
  GyroPair& pair_;  ///< archived with the shared estimators
};

/// The adaptive identifier of Mach 2003, chapter 3, beside the others: it has no value that could come into force.
class AdaptiveUnit : public CalibratorUnit {
 public:
  AdaptiveUnit(const SuiteOptions&, SharedEstimators&) {}
  void update_turn(const TurnStep& step) override {
    // Its steps of Euler's method become unstable when they are long, or the hull spins.
    constexpr double kLongest_s = 0.5, kMost = 1e3;
    if (step.begins_segment || step.duration_s > kLongest_s || !(step.bias_time_s > 0))
      return identifier_.restart();
    heading_rad_ += std::remainder(step.heading_rad - heading_rad_, 2 * std::numbers::pi);
    identifier_.set_period(step.duration_s);
    identifier_.update(heading_rad_, step.roll_rad, step.pitch_rad, step.measured_angle_rad / step.bias_time_s);
    time_s_ += step.duration_s;
    if (!(identifier_.estimate().norm() < kMost)) start();
  }
  void start() override {
    identifier_ = thesis::AdaptiveIdentifier(kUsual_s);
    time_s_ = 0;
  }
  void put_estimate(Correction& into) const override { put_added(into, {}); }
  [[nodiscard]] Judgement judgement() const override {
    Judgement shown;
    shown.condition = std::numeric_limits<double>::infinity();
    return shown.refused("for comparison only: it states no error, and never comes into force", "");
  }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    constexpr double kSettled_s = 60;
    if (time_s_ < kSettled_s) return {};
    const Eigen::Vector2d estimate = identifier_.estimate();
    return {{kRateNames[0], estimate[0], kUnknownStd}, {kRateNames[1], estimate[1], kUnknownStd}};
  }
  void archive(Archive& archive) override {
    archive.tag("adaptive_unit 1");
    archive(identifier_, heading_rad_, time_s_);
  }

 private:
  static constexpr double kUsual_s = 0.1;

  thesis::AdaptiveIdentifier identifier_{kUsual_s};
  double heading_rad_ = 0;  ///< unwrapped
  double time_s_ = 0;       ///< of all steps
};

template <class Unit, auto member>
constexpr CalibratorRow gyro_row(std::string_view name, std::string_view title) {
  return {.name = name,
          .title = title,
          .needs = {.compass = true, .rate = true},
          .needs_text = "a compass and an inertial card (protocol imu-card)",
          .corrects = Corrects::rate,
          .automatic = true,
          .place = place_of<member>(),
          .values = [](const Correction& correction) { return values_of_rate(*(correction.*member)); },
          .make = make_unit<Unit>};
}

}  // namespace

namespace calibrator_rows {
extern const CalibratorRow gyro, gyro_b, adaptive;
constinit const CalibratorRow adaptive{.name = "adaptive",
                                       .title = "Adaptive identifier",
                                       .needs = {.compass = true, .rate = true},
                                       .needs_text = "a compass and an inertial card (protocol imu-card)",
                                       .corrects = Corrects::rate,
                                       .only_shown = true,
                                       .value_names = kRateNames,
                                       .make = make_unit<AdaptiveUnit>};
constinit const CalibratorRow gyro = gyro_row<GyroUnit, &Correction::gyro>("gyro", "Gyro A");
constinit const CalibratorRow gyro_b = gyro_row<GyroBUnit, &Correction::gyro_b>("gyro_b", "Gyro B");
}  // namespace calibrator_rows
}  // namespace navcal::calib

// SPDX-License-Identifier: Apache-2.0
// Deviation A..E against an external reference of the true heading: of the heading that the compass states, and of
// the one that follows from the calibrated field.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "calib/reference/heading_reference.h"
#include "calib/suite/calibrator_unit.h"
#include "calib/suite/deviation_names.h"
#include "calib/suite/suite_options.h"

namespace navcal::calib {
namespace {

/// A standard error from which on the readings have not told more than the prior.
constexpr double kReferenceUndetermined_rad = 0.3;
constexpr std::uint32_t kReferencePairs = 50;  ///< of a held-out block

DeviationCorrection deviation_of(std::span<const double> value) {
  DeviationCorrection deviation;
  std::copy_n(value.begin(), std::min(value.size(), deviation.coefficients_rad.size()),
              deviation.coefficients_rad.begin());
  return deviation;
}

/// Heading from which the unit counts: of the calibrated field, or as the compass states it.
std::optional<double> base_heading(bool of_field, const CompassReading& reading, const Correction& in_force) {
  if (!of_field) return reading.heading_rad;
  if (!in_force.magnetometer || !reading.field_body_uT || !reading.pitch_rad || !reading.roll_rad)
    return std::nullopt;
  return levelled_heading((*in_force.magnetometer)(*reading.field_body_uT), *reading.roll_rad, *reading.pitch_rad);
}

template <bool of_field>
class ReferenceUnit : public CalibratorUnit {
 public:
  ReferenceUnit(const SuiteOptions& options, SharedEstimators&)
      : declination_rad_(options.local_field.declination_rad), parameters_{.heading_noise_rad =
                                                                               options.heading_noise_rad},
        estimator_(parameters_) {}

  void update_reference(const ReferenceReading& reading) override {
    ++references_;
    track_.update(reading);
  }
  void update_learnt(const LearntReading& learnt) override {
    const auto heading_rad = base_heading(of_field, learnt.reading, learnt.in_force);
    const auto best_rad = best_heading(learnt.in_force, learnt.reading);
    if (!heading_rad || !best_rad) return;
    const double gain_rad = std::remainder(*best_rad - *heading_rad, 2 * std::numbers::pi);
    track_.update({learnt.reading.time_s, learnt.reading.time_std_s, *heading_rad}, [&](const HeadingPair& pair) {
      judge(pair, gain_rad);
      estimator_.update(pair);
    });
  }
  void start() override {
    estimator_ = HeadingReference(parameters_);
    track_ = {};
    comparison_ = {};
    pairs_ = 0;
  }
  void on_in_force(Calibrator changed, const Correction&) override {
    const Corrects corrects = row_of(changed).corrects;
    if (corrects != Corrects::rate) {
      comparison_.on_change();
      pairs_ = 0;
    }
    // The motor's field is taken off the compass's heading, too.
    const bool is_new_heading = of_field ? corrects == Corrects::field : changed == Calibrator::motor_current;
    if (is_new_heading) start();
  }
  void on_local_field(const SuiteOptions& options) override {
    declination_rad_ = options.local_field.declination_rad;
  }
  void put_estimate(Correction& into) const override {
    const auto estimate = estimator_.estimate(declination_rad_);
    if (!estimate) return put_added(into, {});
    const auto& x = estimate->coefficients;
    const std::array<double, 5> numbers{x[0], x[1], x[2], x[3], x[4]};
    put_added(into, numbers);
  }
  [[nodiscard]] Judgement judgement() const override {
    Judgement judgement = estimator_.judgement(declination_rad_);
    if (references_ == 0) {
      judgement.reason = "no reading of the heading reference so far";
      judgement.manoeuvre.clear();
    } else if (of_field && judgement.samples == 0) {
      judgement.reason = "no calibration of the magnetometer is active, or no reference came since it is";
      judgement.manoeuvre.clear();
    }
    return judgement;
  }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    std::vector<Quantity> quantities;
    const auto estimate = estimator_.estimate(declination_rad_);
    if (!estimate) return quantities;
    for (int i = 0; i < 5; ++i)
      quantities.push_back(determined(kDeviationNames[static_cast<std::size_t>(i)], estimate->coefficients[i],
                                      std_of(estimate->covariance(i, i)), kReferenceUndetermined_rad));
    quantities.push_back({"delay_s", estimate->coefficients[5], std_of(estimate->covariance(5, 5))});
    quantities.push_back({"residual_rad", estimate->residual_rad, kUnknownStd});
    return quantities;
  }
  [[nodiscard]] Eigen::MatrixXd covariance() const override {
    const auto estimate = estimator_.estimate(declination_rad_);
    return estimate ? Eigen::MatrixXd(estimate->covariance) : Eigen::MatrixXd();
  }
  [[nodiscard]] OwnComparison comparison() const override { return {&comparison_, HeldOutQuantity::heading}; }
  void archive(Archive& archive) override {
    archive.tag("reference_unit 1");
    archive(declination_rad_, estimator_, track_, references_, comparison_, held_out_.coefficients_rad, pairs_,
            before_, in_force_, estimate_);
  }

 private:
  /// Compares on pairs that the estimate has not seen: it is that of the beginning of their block. `gain_rad`: the
  /// best heading less the one from which the unit counts.
  void judge(const HeadingPair& pair, double gain_rad) {
    if (pairs_ == 0) {
      const auto estimate = estimator_.estimate(declination_rad_);
      if (!estimate) return;
      for (int i = 0; i < 5; ++i)
        held_out_.coefficients_rad[static_cast<std::size_t>(i)] = estimate->coefficients[i];
      before_ = in_force_ = estimate_ = 0;
    }
    const auto square = [&](double magnetic_rad) {
      const double error =
          std::remainder(magnetic_rad + declination_rad_ - pair.reference_rad, 2 * std::numbers::pi);
      return error * error;
    };
    before_ += square(pair.heading_rad);
    in_force_ += square(pair.heading_rad + gain_rad);
    estimate_ += square(held_out_(pair.heading_rad));
    if (++pairs_ < kReferencePairs) return;
    comparison_.add(before_ / kReferencePairs, in_force_ / kReferencePairs, estimate_ / kReferencePairs);
    pairs_ = 0;
  }

  double declination_rad_;
  HeadingReference::Parameters parameters_;
  HeadingReference estimator_;
  ReferenceTrack track_;
  std::uint64_t references_ = 0;
  Comparison comparison_;
  // The held-out block under way.
  DeviationCorrection held_out_;
  std::uint32_t pairs_ = 0;
  double before_ = 0, in_force_ = 0, estimate_ = 0;
};

double apply_deviation(std::span<const double> value, const CompassReading& /*reading*/, double heading_rad) {
  return deviation_of(value)(heading_rad);
}

constexpr CalibratorRow reference_row(std::string_view name, std::string_view title, std::string_view needs_text,
                                      AppliesTo applies_to, decltype(CalibratorRow::make) make) {
  return {.name = name,
          .title = title,
          .needs = {.compass = true, .reference = true},
          .needs_text = needs_text,
          .corrects = Corrects::heading,
          .automatic = true,
          .of_compass = true,
          .value_names = kDeviationNames,
          .apply = apply_deviation,
          .applies_to = applies_to,
          .gives_offset = true,
          .make = make};
}

}  // namespace

namespace calibrator_rows {
extern const CalibratorRow reference_compass, reference_field;
constinit const CalibratorRow reference_compass = reference_row(
    "reference_compass", "Compass by reference", "a compass and a heading reference (roles.heading_reference)",
    AppliesTo::measured, make_unit<ReferenceUnit<false>>);
constinit const CalibratorRow reference_field =
    reference_row("reference_field", "Field by reference",
                  "a compass with its field and a heading reference (roles.heading_reference)", AppliesTo::field,
                  make_unit<ReferenceUnit<true>>);
}  // namespace calibrator_rows
}  // namespace navcal::calib

// SPDX-License-Identifier: Apache-2.0
// The calibrators that compare the heading with the way over ground. Both are estimated by GpsCalibrators, which
// the GPS-aided compass feeds and archives.
#include <array>

#include "calib/suite/calibrator_unit.h"
#include "calib/suite/deviation_names.h"
#include "calib/suite/shared_estimators.h"

namespace navcal::calib {
namespace {

/// A standard error from which on the readings have not told more than the prior of 0.1 (GpsCompass).
constexpr double kGpsDeviationUndetermined_rad = 0.09;

class GpsCompassUnit : public CalibratorUnit {
 public:
  GpsCompassUnit(const SuiteOptions&, SharedEstimators& shared) : gps_(shared.gps) {}
  void update_learnt(const LearntReading& learnt) override {
    gps_.update(learnt.reading, learnt.track, learnt.in_force);
  }
  void update_ground(const GroundReading& reading, const Correction& in_force) override {
    gps_.update(reading, in_force);
  }
  void update_shaft(const MotorReading& reading) override { gps_.update(reading); }
  void start() override { gps_.start_compass(); }
  void on_in_force(Calibrator changed, const Correction&) override {
    if (row_of(changed).corrects == Corrects::field) start();
  }
  void on_local_field(const SuiteOptions& options) override {
    gps_.set_declination(options.local_field.declination_rad);
  }
  void put_estimate(Correction& into) const override {
    into.gps_compass.reset();
    const auto& estimate = gps_.gps_compass().estimate();
    if (!estimate) return;
    const auto& u = estimate->unknowns;
    into.gps_compass = DeviationCorrection{{u[0], u[1], u[2], u[3], u[4]}};
  }
  [[nodiscard]] Judgement judgement() const override { return gps_.gps_compass().judgement(); }
  [[nodiscard]] std::vector<Quantity> quantities() const override;
  [[nodiscard]] Eigen::MatrixXd covariance() const override {
    const auto& estimate = gps_.gps_compass().estimate();
    if (!estimate) return {};
    return estimate->covariance;
  }
  void archive(Archive& archive) override { archive(gps_); }

 private:
  GpsCalibrators& gps_;
};

std::vector<Quantity> GpsCompassUnit::quantities() const {
  std::vector<Quantity> quantities;
  const auto& estimate = gps_.gps_compass().estimate();
  if (!estimate) return quantities;
  const auto std = [&](int i) { return std_of(estimate->covariance(i, i)); };
  for (int i = 0; i < 5; ++i)
    quantities.push_back(determined(kDeviationNames[static_cast<std::size_t>(i)], estimate->unknowns[i], std(i),
                                    kGpsDeviationUndetermined_rad));
  constexpr std::array<std::string_view, 4> kOthers{"speed_scale", "slip_s", "current_north_m_s",
                                                    "current_east_m_s"};
  for (int i = 0; i < 4; ++i)
    quantities.push_back({kOthers[static_cast<std::size_t>(i)], estimate->unknowns[5 + i], std(5 + i)});
  return quantities;
}

class MisalignmentUnit : public CalibratorUnit {
 public:
  MisalignmentUnit(const SuiteOptions&, SharedEstimators& shared) : gps_(shared.gps) {}
  void start() override { gps_.start_misalignment(); }
  void on_in_force(Calibrator changed, const Correction&) override {
    const Corrects corrects = row_of(changed).corrects;
    if (corrects == Corrects::offset) gps_.on_change();
    // The misalignment was estimated for another heading.
    if (corrects == Corrects::heading || corrects == Corrects::field) start();
  }
  void put_estimate(Correction& into) const override {
    const auto estimate = gps_.misalignment().estimate();
    into.misalignment_rad = estimate ? std::optional(estimate->offset_rad) : std::nullopt;
  }
  [[nodiscard]] Judgement judgement() const override { return gps_.misalignment().judgement(); }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    const auto estimate = gps_.misalignment().estimate();
    if (!estimate) return {};
    return {{"A_rad", estimate->offset_rad, estimate->offset_std_rad}};
  }
  [[nodiscard]] OwnComparison comparison() const override {
    return {&gps_.comparison(), HeldOutQuantity::heading};
  }
  void archive(Archive&) override {}

 private:
  GpsCalibrators& gps_;
};

}  // namespace

namespace calibrator_rows {
extern const CalibratorRow gps_compass, misalignment;
constinit const CalibratorRow gps_compass{
    .name = "gps_compass",
    .title = "Compass by GPS",
    .needs = {.compass = true, .ground = true, .motor = true},
    .needs_text = "a compass, a GPS receiver and the motor card",
    .needs_advance = true,
    .corrects = Corrects::heading,
    .automatic = true,
    .of_compass = true,
    .place = place_of<&Correction::gps_compass>(),
    .values = [](const Correction& correction) { return values_of_deviation(*correction.gps_compass); },
    .make = make_unit<GpsCompassUnit>};
constinit const CalibratorRow misalignment{
    .name = "misalignment",
    .title = "Misalignment A",
    .needs = {.compass = true, .ground = true},
    .needs_text = "a compass and a GPS receiver (protocol oncore or nmea)",
    .corrects = Corrects::offset,
    .automatic = true,
    .of_compass = true,
    .place = place_of<&Correction::misalignment_rad>(),
    .values =
        [](const Correction& correction) {
          return std::vector<NamedNumbers>{{"A_rad", {*correction.misalignment_rad}}};
        },
    .make = make_unit<MisalignmentUnit>};
}  // namespace calibrator_rows
}  // namespace navcal::calib

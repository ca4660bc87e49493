// SPDX-License-Identifier: Apache-2.0
// Hard and soft iron from the measured field itself.
#include <cmath>

#include "calib/suite/calibrator_unit.h"
#include "calib/suite/shared_estimators.h"

namespace navcal::calib {
namespace {

/// Factor by which a smoothed tilt is better than a reading of the inclinometer.
constexpr double kSmoothing = 3.6;

class MagnetometerUnit : public CalibratorUnit {
 public:
  MagnetometerUnit(const SuiteOptions& options, SharedEstimators& shared) : options_(options), shared_(shared) {}
  void update_learnt(const LearntReading& learnt) override {
    const auto& [reading, turn, track, gyro, in_force] = learnt;
    if (!reading.field_body_uT) return;
    // The size of the field gives information on iron even without tilt.
    Magnetometer::Reading field;
    field.field_body_uT = *reading.field_body_uT;
    // Where the gyros are known, without the inclinometer's lag.
    field.roll_rad = turn ? turn->roll_rad : reading.roll_rad.value_or(NAN);
    field.pitch_rad = turn ? turn->pitch_rad : reading.pitch_rad.value_or(NAN);
    if (turn) magnetometer().set_tilt_noise(options_.tilt_noise_rad / (turn->tilt_restored ? kSmoothing : 1));
    field.has_turn = turn.has_value();
    if (turn) field.turn = *turn;
    field.time_s = reading.time_s;
    field.utc_ns = reading.utc_ns;
    magnetometer().update(field);
  }
  void settle() override { magnetometer().settle(); }
  void start() override {
    magnetometer() = Magnetometer(field_parameters(options_));
    take_over_gyro();
  }
  void on_in_force(Calibrator changed, const Correction&) override {
    if (changed == Calibrator::gyro) take_over_gyro();
    if (row_of(changed).corrects == Corrects::field) start();
  }
  void on_local_field(const SuiteOptions& options) override {
    options_ = options;
    magnetometer().set_known_field(options.local_field.known);
  }
  void put_estimate(Correction& into) const override {
    const auto estimate = magnetometer().estimate();
    into.magnetometer = estimate ? std::optional(estimate->correction) : std::nullopt;
  }
  [[nodiscard]] Judgement judgement() const override { return magnetometer().judgement(); }
  [[nodiscard]] std::vector<Quantity> quantities() const override;
  void archive(Archive& archive) override { archive(magnetometer()); }

 private:
  [[nodiscard]] Magnetometer& magnetometer() { return shared_.magnetometer; }
  [[nodiscard]] const Magnetometer& magnetometer() const { return shared_.magnetometer; }
  void take_over_gyro() {
    if (!shared_.gyro.judgement().accepted) return;
    const TurnCoefficients gyro = shared_.gyro.filter().estimate();
    magnetometer().set_gyro({gyro.head<2>(), shared_.gyro.filter().covariance().topLeftCorner<2, 2>()});
  }

  SuiteOptions options_;
  SharedEstimators& shared_;
};

std::vector<Quantity> MagnetometerUnit::quantities() const {
  const auto estimate = magnetometer().estimate();
  if (!estimate) return {};
  const auto& offset = estimate->correction.offset_uT;
  const auto& std = estimate->offset_std_uT;
  const auto &matrix = estimate->correction.matrix, &matrix_std = estimate->matrix_std;
  std::vector<Quantity> quantities{{"offset_x_uT", offset.x(), std.x()},
                                   {"offset_y_uT", offset.y(), std.y()},
                                   {"offset_z_uT", offset.z(), std.z()},
                                   {"field_uT", estimate->field_uT, kUnknownStd},
                                   {"residual_uT", estimate->residual_uT, kUnknownStd},
                                   {"worst_heading_rad", 0, estimate->heading_std_rad},
                                   {"matrix_xx", matrix(0, 0), matrix_std(0, 0)},
                                   {"matrix_yy", matrix(1, 1), matrix_std(1, 1)},
                                   {"matrix_zz", matrix(2, 2), matrix_std(2, 2)},
                                   {"matrix_yz", matrix(1, 2), matrix_std(1, 2)},
                                   {"matrix_xz", matrix(0, 2), matrix_std(0, 2)},
                                   {"matrix_xy", matrix(0, 1), matrix_std(0, 1)}};
  if (estimate->field_scale > 0)
    quantities.push_back({"field_scale", estimate->field_scale, estimate->field_scale_std});
  return quantities;
}

std::vector<NamedNumbers> values_of_field(const FieldCorrection& field) {
  const auto& o = field.offset_uT;
  const auto& m = field.matrix;
  return {{"offset_uT", {o.x(), o.y(), o.z()}, 1},
          {"matrix", {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)}, 3}};
}

}  // namespace

namespace calibrator_rows {
extern const CalibratorRow magnetometer;
constinit const CalibratorRow magnetometer{
    .name = "magnetometer",
    .title = "Magnetometer",
    .needs = {.compass = true},
    .needs_text = "a compass that gives its field (protocol tcm2)",
    .corrects = Corrects::heading,
    .automatic = true,
    .of_compass = true,
    .field_alone = true,
    .clears_rose = true,
    .place = place_of<&Correction::magnetometer>(),
    .values = [](const Correction& correction) { return values_of_field(*correction.magnetometer); },
    .make = make_unit<MagnetometerUnit>};
}  // namespace calibrator_rows
}  // namespace navcal::calib

// SPDX-License-Identifier: Apache-2.0
// Deviation B..E of the compass against the turns of the gyro.
#include <numbers>

#include "calib/suite/calibrator_unit.h"
#include "calib/suite/deviation_names.h"
#include "calib/suite/shared_estimators.h"

namespace navcal::calib {
namespace {

/// A standard error from which on the readings have not told more than was known before them.
constexpr double kDeviationUndetermined_rad = std::numbers::pi;

class CompassUnit : public CalibratorUnit {
 public:
  CompassUnit(const SuiteOptions& options, SharedEstimators& shared)
      : compass_(TurnCalibrator::Subject::compass, turn_parameters(options)), gyro_(shared.gyro) {}
  void update_turn(const TurnStep& step) override { compass_.update(step); }
  void start() override { compass_.start(prior()); }
  void on_in_force(Calibrator changed, const Correction&) override {
    if (row_of(changed).corrects == Corrects::field) start();
  }
  void put_estimate(Correction& into) const override {
    into.compass.reset();
    if (!compass_.has_estimate()) return;
    const TurnCoefficients estimate = compass_.filter().estimate();
    into.compass = DeviationCorrection{{0, estimate[kB], estimate[kC], estimate[kD], estimate[kE]}};
  }
  [[nodiscard]] Judgement judgement() const override { return compass_.judgement(); }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    std::vector<Quantity> quantities;
    if (!compass_.has_estimate()) return quantities;
    const TurnCoefficients estimate = compass_.filter().estimate();
    const TurnCovariance covariance = compass_.filter().covariance();
    for (int i = kB; i <= kE; ++i) {
      const int above_A = i - kB + 1;
      quantities.push_back(determined(kDeviationNames[static_cast<std::size_t>(above_A)], estimate[i],
                                      std_of(covariance(i, i)), kDeviationUndetermined_rad));
    }
    return quantities;
  }
  [[nodiscard]] Eigen::MatrixXd covariance() const override {
    if (!compass_.has_estimate()) return {};
    return compass_.filter().covariance().block<4, 4>(kB, kB);
  }
  void archive(Archive& archive) override { archive(compass_); }

 private:
  /// The compass keeps what is known of the gyro.
  [[nodiscard]] TurnPrior prior() const {
    if (!gyro_.judgement().accepted) return TurnPrior::unknown_both();
    const TurnCoefficients gyro = gyro_.filter().estimate();
    return TurnPrior::unknown_compass(gyro[kScale], gyro[kBias],
                                      gyro_.filter().covariance().topLeftCorner<2, 2>());
  }

  TurnCalibrator compass_;
  const TurnCalibrator& gyro_;
};

}  // namespace

namespace calibrator_rows {
extern const CalibratorRow compass;
constinit const CalibratorRow compass{
    .name = "compass",
    .title = "Compass deviation",
    .needs = {.compass = true, .rate = true},
    .needs_text = "a compass and an inertial card (protocol imu-card)",
    .corrects = Corrects::heading,
    .automatic = true,
    .of_compass = true,
    .clears_rose = true,
    .place = place_of<&Correction::compass>(),
    .values = [](const Correction& correction) { return values_of_deviation(*correction.compass); },
    .make = make_unit<CompassUnit>};
}  // namespace calibrator_rows
}  // namespace navcal::calib

// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/refinement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/identify/identification_case.h"

namespace navcal::identify {
namespace {

/// A vehicle drawn from its layout's errors, with perfect instruments but for their noise.
struct DrivenVehicle {
  VehicleCase of = vehicle_case("rov");
  DrawnVehicle drawn;
  std::vector<RecordedMotion> recordings;

  explicit DrivenVehicle(std::uint64_t seed)
      : drawn(draw_vehicle(of, seed)), recordings{draw_recording(of, drawn.layout, 30, seed + 1, 0)} {}
  std::optional<Refinement> refined_from(const Eigen::VectorXd& start) const {
    return refined(of.prior, uncertain_parameters(of.prior), start, recordings, 2);
  }
};

TEST(Refinement, FromThePriorThePredictionsImproveAndTheErrorsHold) {
  double squares = 0, count = 0;
  for (const std::uint64_t seed : {11U, 21U, 31U}) {
    const DrivenVehicle vehicle(seed);
    const Eigen::VectorXd priors = prior_values(uncertain_parameters(vehicle.of.prior));
    const auto found = vehicle.refined_from(priors);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(found->error_ratio, 0.9) << seed;
    const Eigen::VectorXd stds = found->covariance.diagonal().cwiseSqrt();
    squares += (found->parameters - vehicle.drawn.truth).cwiseQuotient(stds).squaredNorm();
    count += static_cast<double>(stds.size());
  }
  EXPECT_LT(std::sqrt(squares / count), 1.5);
  RecordProperty("z", std::to_string(std::sqrt(squares / count)));
}

TEST(Refinement, AtTheTruthThereIsLittleToGain) {
  const DrivenVehicle vehicle(41);
  const auto found = vehicle.refined_from(vehicle.drawn.truth);
  ASSERT_TRUE(found.has_value());
  EXPECT_GT(found->error_ratio, 0.9);  // 0.57 but for the fit's freedom
}

TEST(Refinement, AVehicleThatLeavesAllBoundsIsNotRefined) {
  DrivenVehicle vehicle(51);
  for (auto& thruster : vehicle.of.prior.thrusters) thruster.force_scale *= 1e6;
  EXPECT_FALSE(vehicle.refined_from(prior_values(uncertain_parameters(vehicle.of.prior))).has_value());
}

}  // namespace
}  // namespace navcal::identify

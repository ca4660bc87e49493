// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/null_mission.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gap/inference/linearised.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

// Fins that ripple in step with the card's reports, and a replay whose steps are a whole frame of the card, each
// made vehicles that are their model speak for wrong fins, thrust or lags, by ten standard errors in seven
// minutes.
TEST(NullMission, OfAVehicleThatIsItsModelSpeaksForNothing) {
  constexpr int kNullMissions = 6;
  const config::VehicleSettings vehicle;
  const Library library({});
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  const Mission recorded = test::simulated_mission("calibration_swing", "", 250, 3);
  const Replay replay(recorded, vehicle);
  Trajectory10Hz course;
  (void)replay.run({}, &course);

  std::vector<Eigen::Index> asked;
  for (Eigen::Index j = Library::kBiases; j < nothing.size(); ++j) {
    const std::string_view name = library[library.unknowns()[static_cast<std::size_t>(j)].effect].name;
    for (const auto of_fins : {"fin_gain", "fin_lag", "imu_latency", "thrust_scale", "yaw_damping"}) {
      if (name == of_fins) asked.push_back(j);
    }
  }
  ASSERT_EQ(asked.size(), 5U);
  Eigen::ArrayXd scores = Eigen::ArrayXd::Zero(5), squares = scores;
  for (std::uint64_t seed = 1; seed <= kNullMissions; ++seed) {
    const Mission mission = null_mission(replay, course, vehicle, sim::EffectSet(), seed);
    const Replay own(mission, vehicle);
    const auto white = Whitening::nominal();
    const Eigen::VectorXd residual = residual_at(own, library, white, nothing);
    const Eigen::MatrixXd design = design_at(own, library, white, nothing, residual, asked, 2);
    scores += (design.transpose() * residual).array() / kNullMissions;
    squares += design.colwise().squaredNorm().transpose().array() / kNullMissions;
  }
  for (Eigen::Index i = 0; i < scores.size(); ++i) {
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(asked[static_cast<std::size_t>(i)])];
    EXPECT_LT(std::abs(scores[i]), 3 * std::sqrt(squares[i])) << library[unknown.effect].name;
  }
}

}  // namespace
}  // namespace navcal::gap

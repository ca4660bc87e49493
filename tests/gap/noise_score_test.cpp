#include "gap/noise_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gap/biases.h"
#include "gap/explanation.h"
#include "gap/set_evidence.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

// A nominal vehicle on a zigzag passed for one whose card and compass are late and whose fins are quick: the noise
// of gyros and compass is in the signatures of latencies as it is in what they are compared with. None of these
// can be negative, and what else was tried saved some of what that costs.
TEST(NoiseScore, TakenOutANominalVehicleOnAZigzagIsNominal) {
  const config::VehicleSettings vehicle;
  const Library library({});
  const Mission mission = test::simulated_mission("thesis3", "", 300, 11);
  const Replay replay(mission, vehicle);
  const Eigen::VectorXd at = with_biases_found(replay, library, 2);
  Course10Hz course;
  (void)replay.run(library.model(at), &course);
  const NullBank bank = make_null_bank(replay, course, vehicle, library, at, {30, 1, 2}, [](double) {});
  const Priors priors = learnt_priors(library, bank.gram, bank.scores);
  const Linearised raw = linearise(replay, library, bank.whitening, at, 2);
  const Linearised clean = without_noise(raw, bank.noise);

  const auto errors_off = [&](const Linearised& linear, std::string_view name) {
    for (std::size_t e = 0; e < library.size(); ++e) {
      if (library[e].name != name) continue;
      const auto posterior = evidence_of(linear, priors).posterior({});
      const Eigen::Index j = library.first(e);
      return posterior.mean[j] / std::sqrt(posterior.covariance(j, j));
    }
    return 0.0;
  };
  EXPECT_GT(std::abs(errors_off(raw, "imu_latency")), 4);
  for (const auto name : {"imu_latency", "fin_lag", "compass_lag"}) {
    EXPECT_LT(std::abs(errors_off(clean, name)), 3) << name;
  }
  EXPECT_LT(impossible_nats({}, clean, library, priors), impossible_nats({}, raw, library, priors) / 2);
}

}  // namespace
}  // namespace navcal::gap

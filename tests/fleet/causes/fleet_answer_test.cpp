// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/fleet_answer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/fleet/causes/simulated_fleet.h"

namespace navcal::fleet {
namespace {

using test::SimulatedFleet;

const CauseProgress kSilent = [](double) {};

FleetAnswer answer_for(unsigned seed, SimulatedFleet::Size size, const SimulatedFleet::Causes& causes) {
  return answer_of_fleet(PooledMissions(SimulatedFleet(seed, size, causes).missions()), 2, kSilent);
}

const PossibleCause& only_cause(const FleetAnswer& answer) {
  if (answer.causes.size() != 1) throw std::runtime_error(std::to_string(answer.causes.size()) + " causes");
  return answer.causes.front().acting.cause;
}
std::string effect_of(const PossibleCause& cause, const SimulatedFleet& fleet) {
  return PooledMissions(fleet.missions()).effects()[cause.effect].name;
}

TEST(FleetAnswer, NamesNothingWhereVehiclesDifferByTheirTolerancesOnly) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const FleetAnswer answer = answer_for(seed, {}, [](std::size_t, std::size_t, Eigen::VectorXd&) {});
    EXPECT_TRUE(answer.causes.empty()) << seed;
    EXPECT_TRUE(answer.undecided.empty()) << seed;
    for (const VehicleAnswer& vehicle : answer.vehicles) EXPECT_EQ(vehicle.verdict, FleetVerdict::no_gap) << seed;
  }
}

TEST(FleetAnswer, TellsWhatBelongsToOneVehicleFromTheDesignAndTheDay) {
  const SimulatedFleet::Causes of_vehicle = [](std::size_t v, std::size_t, Eigen::VectorXd& values) {
    if (v == 2) values[0] += 0.2;
  };
  const SimulatedFleet::Causes of_design = [](std::size_t, std::size_t, Eigen::VectorXd& values) {
    values[0] += 0.2;
  };
  const SimulatedFleet::Causes of_day = [](std::size_t, std::size_t k, Eigen::VectorXd& values) {
    if (k == 3) values[4] += 0.2;
  };
  const auto first = answer_for(1, {}, of_vehicle);
  EXPECT_EQ(only_cause(first).level, CauseLevel::vehicle);
  EXPECT_EQ(only_cause(first).of, "v2");
  EXPECT_FALSE(only_cause(first).since);
  EXPECT_EQ(first.vehicles[2].verdict, FleetVerdict::explained);
  const auto second = answer_for(1, {}, of_design);
  EXPECT_EQ(only_cause(second).level, CauseLevel::design);
  EXPECT_NEAR(second.causes.front().mean[0], 0.2, 0.03);
  const auto third = answer_for(1, {}, of_day);
  EXPECT_EQ(only_cause(third).level, CauseLevel::day);
  EXPECT_EQ(only_cause(third).of, "day 3");
}

TEST(FleetAnswer, FindsWhenAnEffectBegan) {
  const auto answer = answer_for(5, {4, 10}, [](std::size_t v, std::size_t k, Eigen::VectorXd& values) {
    if (v == 1 && k >= 6) values[1] += 0.3;
  });
  EXPECT_EQ(only_cause(answer).of, "v1");
  ASSERT_TRUE(only_cause(answer).since);
  EXPECT_EQ(*only_cause(answer).since, 6U);
  EXPECT_FALSE(only_cause(answer).until);
}

TEST(FleetAnswer, FindsAWeakEffectOfTheDesignThatNoMissionShows) {
  const auto answer =
      answer_for(8, {10, 6}, [](std::size_t, std::size_t, Eigen::VectorXd& values) { values[2] += 0.06; });
  EXPECT_EQ(only_cause(answer).level, CauseLevel::design);
}

TEST(FleetAnswer, SaysThatALagCannotBeNegative) {
  const auto answer = answer_for(3, {}, [](std::size_t v, std::size_t, Eigen::VectorXd& values) {
    if (v == 0) values[3] -= 0.3;
  });
  for (const FoundCause& cause : answer.causes) EXPECT_NE(cause.acting.cause.effect, 2U);
}

TEST(FleetAnswer, IsUnknownWhereWhatIsThereIsNotInTheLibrary) {
  SimulatedFleet fleet(4, {5, 8}, [](std::size_t, std::size_t, Eigen::VectorXd&) {});
  auto missions = fleet.missions();
  for (FleetMission& mission : missions) {
    if (mission.vehicle == "v3") mission.information.power *= 1.5;
  }
  const FleetAnswer answer = answer_of_fleet(PooledMissions(std::move(missions)), 2, kSilent);
  EXPECT_EQ(answer.vehicles[3].verdict, FleetVerdict::unknown);
  EXPECT_NE(answer.vehicles[3].reason.find("closes"), std::string::npos);
  EXPECT_EQ(answer.vehicles[2].verdict, FleetVerdict::no_gap);
}

// Vehicles of one layout differ by more than 2 %: that belongs to none of them as a cause.
TEST(FleetAnswer, WhatVehiclesOfADesignMayDifferInIsNoCause) {
  SimulatedFleet fleet(6, {5, 8}, [](std::size_t v, std::size_t, Eigen::VectorXd& values) {
    if (v == 1) values[0] += 0.3;
  });
  auto missions = fleet.missions();
  const auto causes = [&] { return answer_of_fleet(PooledMissions(missions), 2, kSilent).causes.size(); };
  EXPECT_EQ(causes(), 1U);
  for (FleetMission& mission : missions) mission.vehicle_error.assign(SimulatedFleet::parameters().size(), 0.3);
  EXPECT_EQ(causes(), 0U);
  missions.front().vehicle_error.pop_back();
  EXPECT_THROW(PooledMissions{missions}, std::invalid_argument);
}

TEST(FleetAnswer, StatesErrorsThatHold) {
  double square = 0;
  constexpr int kFleets = 12;
  for (unsigned seed = 0; seed < kFleets; ++seed) {
    const auto answer = answer_for(100 + seed, {4, 6}, [](std::size_t v, std::size_t, Eigen::VectorXd& values) {
      if (v == 1) values[0] += 0.5;
    });
    ASSERT_EQ(answer.causes.size(), 1U);
    // The standard error contains the tolerance of the vehicle, which adds to the effect.
    const double error = (answer.causes.front().mean[0] - 0.5) / answer.causes.front().std[0];
    square += error * error / kFleets;
  }
  EXPECT_LT(std::sqrt(square), 1.6);
  EXPECT_GT(std::sqrt(square), 0.5);
}

TEST(FleetAnswer, DoesNotDependOnTheOrderOfTheMissions) {
  const SimulatedFleet fleet(6, {3, 5}, [](std::size_t v, std::size_t k, Eigen::VectorXd& values) {
    if (v == 1 && k > 2) values[0] += 0.4;
  });
  auto backwards = fleet.missions();
  std::reverse(backwards.begin(), backwards.end());
  const auto a = answer_of_fleet(PooledMissions(fleet.missions()), 1, kSilent);
  const auto b = answer_of_fleet(PooledMissions(std::move(backwards)), 2, kSilent);
  ASSERT_EQ(a.causes.size(), b.causes.size());
  EXPECT_EQ(effect_of(only_cause(a), fleet), "fin_gain");
  EXPECT_EQ(a.causes.front().mean[0], b.causes.front().mean[0]);
}

TEST(FleetAnswer, HandlesASingleMission) {
  const auto answer =
      answer_for(2, {1, 1}, [](std::size_t, std::size_t, Eigen::VectorXd& values) { values[0] += 1; });
  ASSERT_EQ(answer.vehicles.size(), 1U);
  EXPECT_EQ(answer.missions.size(), 1U);
}

TEST(PooledMissions, RefusesNoneAndDifferentLibraries) {
  EXPECT_THROW(PooledMissions({}), std::invalid_argument);
  auto missions = SimulatedFleet(1, {1, 2}, [](std::size_t, std::size_t, Eigen::VectorXd&) {}).missions();
  missions.back().information.parameters.front().effect = "other";
  EXPECT_THROW(PooledMissions(std::move(missions)), std::invalid_argument);
}

}  // namespace
}  // namespace navcal::fleet

// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/plan.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <stdexcept>

#include "tests/validation/reference/thrusters/shipped_plan.h"

namespace navcal::reference::thrusters::testing {
namespace {

constexpr const char* kSmall =
    "[body]\nmass_kg = 10\ninertia_kg_m2 = [1, 2, 3]\nneutral = true\n[[thruster]]\nname = \"a\"\n"
    "place_m = [0, 1, 0]\ndirection = [2, 0, 0]\ncommand = \"percent\"\ntable_command = [-100, 100]\n"
    "table_force_N = [-4, 8]\n";

std::string complaint_about(const std::string& text) {
  try {
    (void)plan_of(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ThrusterPlan, ShippedLayoutsAreRead) {
  for (const char* const name : kThrusterLayouts) {
    const Plan plan = shipped_plan(name);
    EXPECT_FALSE(plan.thrusters.empty()) << name;
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(inertia(plan));
    EXPECT_GT(solver.eigenvalues().minCoeff(), 0) << name;
    for (const PlannedThruster& thruster : plan.thrusters) {
      EXPECT_NEAR(thruster.direction.norm(), 1, 1e-12) << name;
      EXPECT_EQ(thruster.bollard_N(thruster.neutral(), plan.density_kg_m3), 0) << name;
      EXPECT_GT(thruster.bollard_N(thruster.high, plan.density_kg_m3), 0) << name;
    }
  }
}

TEST(ThrusterPlan, DefaultsAreThoseOfTheFormat) {
  const Plan plan = plan_of(kSmall);
  EXPECT_DOUBLE_EQ(plan.buoyancy_N, 98.1);
  const PlannedThruster& thruster = plan.thrusters.front();
  EXPECT_EQ(thruster.low, -100);
  EXPECT_EQ(thruster.lag_s, 0.1);
  EXPECT_EQ(thruster.reaction_sign, -1);
  EXPECT_DOUBLE_EQ(thruster.bollard_N(0, 1000), 2);
  EXPECT_DOUBLE_EQ(thruster.bollard_N(200, 1000), 8);
}

TEST(ThrusterPlan, InertiaAboutTheOriginIsTurnedToTheCentreOfGravityAndBack) {
  std::string text = kSmall;
  text.insert(text.find("neutral"), "gravity_centre_m = [0.1, 0, 0.2]\ninertia_about = \"origin\"\n");
  const Matrix6 M = inertia(plan_of(text));
  EXPECT_NEAR(M(3, 3), 1, 1e-12);
  EXPECT_NEAR(M(4, 4), 2, 1e-12);
  EXPECT_NEAR(M(0, 4), 10 * 0.2, 1e-12);
  EXPECT_NEAR(M(1, 5), 10 * 0.1, 1e-12);
  EXPECT_NEAR((M - M.transpose()).norm(), 0, 1e-12);
}

TEST(ThrusterPlan, APropellersThrustGrowsWithTheSquareOfItsSpeed) {
  std::string text = kSmall;
  text = text.substr(0, text.find("command"));
  const Plan plan = plan_of(text +
                            "command = \"rpm\"\nlimits = [-600, 600]\ndiameter_m = 0.1\nKT = [0.4, -0.3]\n"
                            "KQ = [0.05]\nreverse_efficiency = 0.5\n");
  const PlannedThruster& thruster = plan.thrusters.front();
  EXPECT_NEAR(thruster.bollard_N(600, 1000), 1000 * 100 * 1e-4 * 0.4, 1e-12);
  EXPECT_NEAR(thruster.bollard_N(-300, 1000), -0.5 * 1000 * 25 * 1e-4 * 0.4, 1e-12);
}

TEST(ThrusterPlan, WhatIsNotThrustersIsRefused) {
  for (const char* const name : {"remus-100", "slocum", "reference"})
    EXPECT_NE(complaint_about(shipped_text(name)), "") << name;
  EXPECT_NE(complaint_about(shipped_text("remus-100")).find("surface"), std::string::npos);
}

TEST(ThrusterPlan, WhatCannotBeIsRefusedByName) {
  const std::string small = kSmall;
  EXPECT_EQ(complaint_about(small), "");
  EXPECT_NE(complaint_about("[body").find("line 1"), std::string::npos);
  EXPECT_NE(complaint_about("").find("body"), std::string::npos);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = small;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_NE(complaint_about(with("mass_kg = 10", "mass_kg = \"x\"")).find("body.mass_kg"), std::string::npos);
  EXPECT_NE(complaint_about(with("mass_kg = 10", "mass_kg = nan")).find("body.mass_kg"), std::string::npos);
  EXPECT_NE(complaint_about(with("[1, 2, 3]", "[1, 2]")).find("inertia_kg_m2"), std::string::npos);
  EXPECT_NE(complaint_about(with("[2, 0, 0]", "[0, 0, 0]")).find("thruster[1].direction"), std::string::npos);
  EXPECT_NE(complaint_about(with("\"percent\"", "\"volt\"")).find("thruster[1].command"), std::string::npos);
  EXPECT_NE(complaint_about(with("[-100, 100]", "[100, -100]")).find("table_command"), std::string::npos);
  EXPECT_NE(complaint_about(small + "lag_s = 0\n").find("lag_s"), std::string::npos);
  EXPECT_NE(complaint_about(small + "limits = [10, 100]\n").find("limits"), std::string::npos);
}

}  // namespace
}  // namespace navcal::reference::thrusters::testing

// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "gap/nulls/null_mission.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

TEST(Library, HoldsEveryEffectThatCanBeACause) {
  const Library library({});
  EXPECT_EQ(library.size(), 34U);
  Eigen::Index next = Library::kBiases;
  for (std::size_t e = 0; e < library.size(); ++e) {
    EXPECT_EQ(library.first(e), next) << library[e].name;
    next += library.count(e);
    EXPECT_TRUE(library.holds(e));
  }
  EXPECT_EQ(static_cast<Eigen::Index>(library.unknowns().size()), next);
  EXPECT_EQ(static_cast<Eigen::Index>(library.moving().size()), next);
}

// Every real vehicle is off by a little either way. What a replay cannot follow below zero looks like something
// else: an inclinometer that felt turns a hundredth the wrong way was a thrust 2 % too strong.
TEST(Library, OnlyTimesAndWidthsEndAtZero) {
  const Library library({});
  for (const Unknown& unknown : library.unknowns()) {
    if (unknown.effect == Library::kNuisance) continue;
    const bool ends = library.is_lag(unknown.effect) || library.is_backlash(unknown.effect);
    EXPECT_EQ(unknown.least >= 0, ends) << library[unknown.effect].name << " " << unknown.name;
    if (ends) continue;
    EXPECT_LT(unknown.least, -5 * kTolerance * unknown.typical) << library[unknown.effect].name;
  }
}

// The step of a backlash is long where there is none yet, and short where it is: with the long one a search led
// away from the backlash that was there.
TEST(Library, WhatBendsIsStepped) {
  const std::vector<std::string_view> lags{"compass_lag", "fin_lag", "gps_latency", "imu_latency"};
  const Library library({});
  for (std::size_t e = 0; e < library.size(); ++e) {
    const std::string_view name = library[e].name;
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(library.first(e))];
    EXPECT_EQ(library.is_lag(e), std::find(lags.begin(), lags.end(), name) != lags.end()) << name;
    EXPECT_EQ(library.is_backlash(e), name == "fin_backlash") << name;
    EXPECT_EQ(library.is_curved(e), library.is_lag(e) || library.is_backlash(e)) << name;
    EXPECT_LE(unknown.onward, unknown.step) << name;
    if (!library.is_backlash(e)) continue;
    EXPECT_LT(unknown.onward, 0.2);
    EXPECT_GT(unknown.step, 0.5);
  }
}

TEST(Library, WhatIsExcludedKeepsItsPlaceAndDoesNotMove) {
  const std::vector<std::string> excluded{"hard_iron"};
  const Library all({}), less(excluded);
  ASSERT_EQ(all.unknowns().size(), less.unknowns().size());
  EXPECT_EQ(less.moving().size() + 3, all.moving().size());
  for (std::size_t e = 0; e < less.size(); ++e) EXPECT_EQ(less.holds(e), less[e].name != "hard_iron");
}

TEST(Library, ANameThatIsNoneIsToldWithTheKnown) {
  const std::vector<std::string> excluded{"hard_irn"};
  try {
    const Library library(excluded);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("hard_iron"), std::string::npos);
  }
}

TEST(Library, AModelHoldsWhatIsNotZeroWithinItsBounds) {
  const Library library({});
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  EXPECT_EQ(library.model(values).effects.size(), 0U);
  for (std::size_t e = 0; e < library.size(); ++e) {
    if (library[e].name == "fin_lag") values[library.first(e)] = -3;
    if (library[e].name == "hard_iron") values[library.first(e) + 1] = 2;
  }
  values[2] = 0.01;
  const Model model = library.model(values);
  ASSERT_EQ(model.effects.size(), 2U);
  EXPECT_EQ(model.bias_rad_s[2], 0.01);
  EXPECT_EQ(model.effects[0].parameters()[0], 0);
  EXPECT_EQ(model.effects[1].parameters()[1], 2);
}

}  // namespace
}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/causes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/identify/identification_case.h"

namespace navcal::diagnosis {
namespace {

TEST(Causes, EveryEffectOfEveryPartIsOneCause) {
  const auto of = identify::vehicle_case("rov");
  identify::RecordedMotion recording;
  recording.channels[static_cast<std::size_t>(identify::Channel::rate_z)] = {{0, 0, 1}};
  const CauseLibrary library = causes_of(of.prior, recording, {});
  const auto count = [&](const std::string& name) {
    return std::count_if(library.causes.begin(), library.causes.end(),
                         [&](const Cause& c) { return c.name == name; });
  };
  EXPECT_EQ(count("thrust_scale"), 8);
  EXPECT_EQ(count("damping"), 6);
  EXPECT_EQ(count("weight"), 1);
  EXPECT_EQ(count("fin_gain"), 0) << "the vehicle has no fins";
  EXPECT_EQ(count("gyro_scale"), 1);
  EXPECT_EQ(count("compass_deviation"), 0) << "the recording has no compass";
  const auto& said = library.not_judged;
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const std::string& remark) {
    return remark.find("compass_deviation was not judged") != std::string::npos;
  }));
  std::set<Eigen::Index> columns;
  for (const Cause& cause : library.causes) {
    for (const Eigen::Index column : cause.columns()) EXPECT_TRUE(columns.insert(column).second) << cause.words();
  }
}

TEST(Causes, WhatMagnetometersCanHaveReplacesTheDeviationOfTheHeadingWhereTheFieldIsKnown) {
  const auto of = identify::vehicle_case("micro");
  identify::RecordedMotion recording;
  recording.channels[static_cast<std::size_t>(identify::Channel::heading)] = {{0, 0, 1}};
  const auto has = [&](std::string_view name, const std::vector<std::string>& excluded = {}) {
    const CauseLibrary library = causes_of(of.prior, recording, excluded);
    EXPECT_EQ(library.replaced.empty(),
              std::ranges::find(library.causes, "compass_deviation", &Cause::name) != library.causes.end());
    return std::ranges::find(library.causes, name, &Cause::name) != library.causes.end();
  };
  EXPECT_TRUE(has("compass_deviation"));
  EXPECT_FALSE(has("hard_iron"));
  identify::set_field(recording, {18, 2, 44});
  EXPECT_FALSE(has("compass_deviation"));
  for (const char* const name : {"hard_iron", "soft_iron", "compass_misalignment"}) EXPECT_TRUE(has(name)) << name;
  EXPECT_TRUE(has("compass_deviation", {"hard_iron"})) << "it stands for what is left out";
}

TEST(Causes, AGyroThatIsNotThereHasNoErrors) {
  const auto of = identify::vehicle_case("micro");
  identify::RecordedMotion recording;
  recording.channels[static_cast<std::size_t>(identify::Channel::rate_z)] = {{0, 0, 1}};
  const CauseLibrary library = causes_of(of.prior, recording, {});
  const auto of_gyros = std::ranges::find(library.causes, "gyro_cross_axis", &Cause::name);
  ASSERT_NE(of_gyros, library.causes.end());
  ASSERT_EQ(of_gyros->parameters.size(), 2U);
  for (const CauseParameter& parameter : of_gyros->parameters)
    EXPECT_TRUE(parameter.name.starts_with("az")) << parameter.name;
}

TEST(Causes, AnExcludedEffectIsNowhereAndAnUnknownNameIsRefused) {
  const auto of = identify::vehicle_case("rov");
  const std::vector<std::string> excluded{"thrust_scale"};
  const CauseLibrary library = causes_of(of.prior, {}, excluded);
  for (const Cause& cause : library.causes) EXPECT_NE(cause.name, "thrust_scale");
  for (const identify::Parameter& parameter : library.parameters)
    EXPECT_EQ(parameter.name.find("thrust_scale"), std::string::npos);
  // No cause of a layout; without it all the same.
  const std::vector<std::string> of_the_reference_vehicle{"compass_lag"};
  EXPECT_NO_THROW(static_cast<void>(causes_of(of.prior, {}, of_the_reference_vehicle)));
  const std::vector<std::string> unknown{"thrust_scales"};
  EXPECT_THROW(static_cast<void>(causes_of(of.prior, {}, unknown)), std::invalid_argument);
}

// A vehicle whose thrust is 20 % above its layout's by all of its nominal recordings has no gap because of it.
// Fitted as independent tolerances without a sign, the same offset hid every cause of that size.
}  // namespace
}  // namespace navcal::diagnosis

// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/state_file.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace navcal::gap {
namespace {

Watch::State some_state() {
  Watch::State state;
  state.change.windows = 2;
  state.change.measurements = 7200;
  state.change.gram = Eigen::MatrixXd::Identity(3, 3);
  state.change.gram(0, 2) = state.change.gram(2, 0) = 0.1;
  state.change.score = Eigen::Vector3d(1, -2, 1.0 / 3);
  state.change.onsets.push_back({1, 0.5 * state.change.gram, 0.5 * state.change.score, 3600});
  state.log_power = Eigen::Vector2d(-1e9, 3);
  state.begins_ns = {1, 30'000'000'001};
  state.skipped = 4;
  state.alarm_ns = 60'000'000'000;
  state.of_source = {0.1, 0.2, 0.3, 0.4};
  return state;
}

TEST(StateFile, GivesBackWhatWasWritten) {
  const Watch::State before = some_state();
  const auto after = read_state(state_text(before, "model"), "model");
  ASSERT_TRUE(after);
  EXPECT_EQ(after->change.windows, before.change.windows);
  EXPECT_EQ(after->change.gram, before.change.gram);
  EXPECT_EQ(after->change.score, before.change.score);
  ASSERT_EQ(after->change.onsets.size(), 1U);
  EXPECT_EQ(after->change.onsets[0].gram, before.change.onsets[0].gram);
  EXPECT_EQ(after->change.onsets[0].measurements, 3600);
  EXPECT_EQ(after->log_power, before.log_power);
  EXPECT_EQ(after->begins_ns, before.begins_ns);
  EXPECT_EQ(after->alarm_ns, before.alarm_ns);
  EXPECT_EQ(after->of_source, before.of_source);
}

TEST(StateFile, RefusesAnotherModelAndGarbage) {
  const std::string text = state_text(some_state(), "model");
  EXPECT_FALSE(read_state(text, "another"));
  EXPECT_FALSE(read_state("", "model"));
  EXPECT_FALSE(read_state("[1,2]", "model"));
  for (std::size_t length = 0; length < text.size(); length += 7) {
    EXPECT_FALSE(read_state(text.substr(0, length), "model"));
  }
}

}  // namespace
}  // namespace navcal::gap

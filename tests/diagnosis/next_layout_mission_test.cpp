// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/next_layout_mission.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/layout_rehearser.h"
#include "tests/diagnosis/micro_case.h"

namespace navcal::diagnosis {
namespace {

using identify::Channel;
using identify::RecordedMotion;

const gap::Progress kSilent = [](std::string_view, double) {};

config::Mission turns() {
  config::Mission mission;
  mission.steps.push_back({.kind = config::StepKind::dive, .depth_m = 1, .seconds = 8});
  mission.steps.push_back({.kind = config::StepKind::circle, .turns = 0.5, .rate_rad_s = 0.3});
  mission.steps.push_back({.kind = config::StepKind::circle, .turns = -0.5, .rate_rad_s = 0.3});
  return mission;
}

/// Rehearses with the instruments of a recording, about the layout itself.
struct Rehearsed {
  explicit Rehearsed(const config::Layout& layout, const RecordedMotion& like)
      : library(causes_of(layout, like, {})), source(layout, library, 1),
        rehearser(layout, library, source, like, Eigen::VectorXd::Zero(library.columns()),
                  [](const gap::Hypothesis& of) { return of.mean; }) {}

  CauseLibrary library;
  FilteredSource source;
  LayoutRehearser rehearser;
};

TEST(LayoutRehearser, ReadingsComeAsOftenAndAsExactAsThoseOfTheRecording) {
  const auto of = micro();
  const RecordedMotion like = recording(of, of.prior, 3);
  const RecordedMotion sailed = Rehearsed(of.prior, like).rehearser.sailed(turns(), like.duration_s);
  for (std::size_t c = 0; c < identify::kChannels; ++c) {
    if (static_cast<Channel>(c) >= Channel::north) continue;  // only at the surface
    const auto& mine = sailed.channels[c];
    const auto& theirs = like.channels[c];
    ASSERT_EQ(mine.empty(), theirs.empty()) << c;
    if (mine.empty()) continue;
    EXPECT_NEAR(static_cast<double>(mine.size()), static_cast<double>(theirs.size()),
                2 + 0.05 * static_cast<double>(theirs.size()))
        << c;
    EXPECT_EQ(mine.front().std, theirs.front().std) << c;
    EXPECT_TRUE(std::ranges::is_sorted(mine, {}, &identify::Reading::time_s)) << c;
  }
  for (const auto& [name, signal] : like.signals) EXPECT_TRUE(sailed.signals.contains(name)) << name;
}

// Readings that the vehicle's own model would not make have innovations beyond their noise.
TEST(LayoutRehearser, AFilterFollowsTheReadingsWithoutAnError) {
  const auto of = micro();
  const RecordedMotion like = recording(of, of.prior, 3);
  Rehearsed rehearsed(of.prior, like);
  const RecordedMotion sailed = rehearsed.rehearser.sailed(turns(), 40);
  const auto power = rehearsed.source.fitted(sailed)->power(Eigen::VectorXd::Zero(rehearsed.library.columns()));
  ASSERT_TRUE(power);
  EXPECT_LT(power->mean_square, 0.2);
}

TEST(LayoutRehearser, PartsOfAMissionAddUpToTheWhole) {
  const auto of = micro();
  const RecordedMotion like = recording(of, of.prior, 3);
  Rehearsed rehearsed(of.prior, like);
  const gap::PlannedPath path = rehearsed.rehearser.path(turns(), 100);
  ASSERT_EQ(path.step_began_s.size(), 3U);
  EXPECT_FALSE(gap::extremes_of(path, {}).shaft_rps);
  const auto [whole, parts] = rehearsed.rehearser.rehearse(turns(), path.duration_s, path.step_began_s);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_TRUE(whole.isApprox(parts[0] + parts[1] + parts[2], 1e-9));
  // A turn tells what turns the vehicle.
  for (const Cause& cause : rehearsed.library.causes) {
    if (cause.words() != "damping of yaw") continue;
    const Eigen::Index column = cause.parameters[0].column;
    EXPECT_GT(parts[1](column, column), 3 * parts[0](column, column));
  }
}

TEST(LayoutRehearser, AMissionThatTheVehicleCannotDoIsNone) {
  const auto of = micro();
  const RecordedMotion like = recording(of, of.prior, 3);
  const Rehearsed rehearsed(of.prior, like);
  config::Mission fins = turns();
  EXPECT_TRUE(rehearsed.rehearser.can(fins));
  fins.steps.push_back({.kind = config::StepKind::doublet,
                        .seconds = 1,
                        .amplitude_rad = 0.1,
                        .times = 2,
                        .on = config::Surface::fin1});
  EXPECT_FALSE(rehearsed.rehearser.can(fins));
}

TEST(NextLayoutMission, SeparatesWhatIsProbableWithinItsLimits) {
  const auto of = micro();
  const config::Layout truth = changed(of.prior, "thruster_lag", "thruster.1", {0.12});
  const LayoutRequest request{.layout = of.prior, .excluded = {}, .threads = 2};
  const auto before = study(
      request, {recording(of, truth, 1), {}, {recording(of, of.prior, 11), recording(of, of.prior, 31)}}, kSilent);
  config::MissionLimits limits;
  limits.duration_s = 90;
  const gap::NextMission next = plan_next_mission(*before, limits, kSilent);
  EXPECT_EQ(next.purpose, gap::MissionPurpose::separate);
  ASSERT_FALSE(next.manoeuvres.empty());
  ASSERT_FALSE(next.sets.empty());
  EXPECT_EQ(next.sets.front().effects, std::vector<std::string>{"thruster_lag of thruster.1"});
  EXPECT_LE(next.path.duration_s, limits.duration_s);
  EXPECT_LT(next.extremes.pitch_rad, 0.8);
  ASSERT_FALSE(next.pairs.empty());
  EXPECT_GT(next.pairs.front().separation_nats, 15);
}

TEST(NextLayoutMission, AVehicleThatCannotBeFollowedGetsNoMission) {
  const auto of = micro();
  const LayoutRequest request{.layout = of.prior, .excluded = {}, .threads = 1, .is_steady = true};
  const auto steady = study(request, {recording(of, of.prior, 1), {}, {}}, kSilent);
  EXPECT_THROW((void)plan_next_mission(*steady, {}, kSilent), std::invalid_argument);
}

}  // namespace
}  // namespace navcal::diagnosis

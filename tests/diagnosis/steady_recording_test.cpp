// SPDX-License-Identifier: Apache-2.0
// A heavy ROV that its controller holds level at one depth: no model can be integrated along such commands, and
// the fault stands in them.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "autopilot/thrust_curve.h"
#include "base/gravity.h"
#include "diagnosis/steady_source.h"
#include "tests/diagnosis/micro_case.h"

namespace navcal::diagnosis {
namespace {

using identify::Channel;
using identify::RecordedMotion;

constexpr std::size_t kFirstVertical = 4;
constexpr double kDuration_s = 12;

config::Layout heavy_rov() {
  config::Layout layout = identify::vehicle_case("rov").prior;
  layout.uncertainties.clear();
  layout.body.buoyancy_N = layout.body.mass_kg * base::kGravity_m_s2 - 24;
  return layout;
}

/// Thrusters of a day: each is some per cent off.
config::Layout of_day(config::Layout layout, std::uint64_t day) {
  std::mt19937_64 random(day);
  std::normal_distribution<double> per_cent(0, 2);
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i)
    layout = changed(layout, "thrust_scale", "thruster." + std::to_string(i + 1), {per_cent(random) / 100});
  return layout;
}

/// Orders of a controller whose vehicle hovers for `duration_s`; before that it stands on the ground.
RecordedMotion hover(const config::Layout& truth, std::uint64_t seed, double ground_s = 0,
                     double duration_s = kDuration_s) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  RecordedMotion motion;
  motion.name = "hover " + std::to_string(seed);
  motion.duration_s = ground_s + duration_s;
  const double lift_N = truth.weight_N() - truth.body.buoyancy_N;
  const sim::ActuatorValues idle = sim::ActuatorValues::neutral(truth);
  for (std::size_t i = 0; i < truth.thrusters.size(); ++i) {
    identify::Signal signal;
    const double up = i < kFirstVertical ? 0 : -lift_N / 4 * truth.thrusters[i].direction[2];
    for (double time_s = 0; time_s < motion.duration_s; time_s += 0.1) {
      const double wanted_N = up * (1 + 0.05 * normal(random));
      signal.times_s.push_back(time_s);
      signal.values.push_back(
          time_s < ground_s || up == 0
              ? idle.thrusters[i]
              : autopilot::command_for(truth.thrusters[i], truth.water_density_kg_m3, wanted_N, 0));
    }
    motion.signals["output" + std::to_string(i + 1)] = std::move(signal);
  }
  for (const Channel channel : {Channel::rate_x, Channel::rate_y, Channel::rate_z, Channel::roll, Channel::pitch,
                                Channel::heading, Channel::gauge_depth}) {
    for (double time_s = 0; time_s < motion.duration_s; time_s += 0.1)
      motion.channels[static_cast<std::size_t>(channel)].push_back(
          {time_s, (channel == Channel::gauge_depth ? 5 : 0) + 0.001 * normal(random), 0.001});
  }
  return motion;
}

gap::Diagnosis steady_diagnosis(const RecordedMotion& recording, const std::vector<RecordedMotion>& others = {}) {
  const config::Layout layout = heavy_rov();
  std::vector<RecordedMotion> nominals;
  for (std::uint64_t day = 1; day <= 6; ++day) nominals.push_back(hover(of_day(layout, day), day));
  LayoutRequest request{.layout = layout, .excluded = {}, .threads = 1};
  request.is_steady = true;
  return diagnose(request, {recording, {}, nominals, others}, [](std::string_view, double) {});
}

TEST(SteadyRecording, NominalVehiclesHaveNoGap) {
  int flagged = 0;
  for (std::uint64_t day = 41; day < 45; ++day) {
    const auto answer = steady_diagnosis(hover(of_day(heavy_rov(), day), day));
    EXPECT_TRUE(answer.effects.empty()) << day << ": " << answer.sentence;
    if (answer.verdict != gap::Verdict::no_gap) ++flagged;
  }
  EXPECT_LE(flagged, 1) << "by chance about one in fifty";
}

TEST(SteadyRecording, AWeakThrusterIsNamedWithItsSizeAlsoBehindTimeOnTheGround) {
  for (const double ground_s : {0.0, 12.0}) {
    const auto answer = steady_diagnosis(
        hover(changed(of_day(heavy_rov(), 51), "thrust_scale", "thruster.7", {-0.3}), 51, ground_s));
    ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
    ASSERT_EQ(answer.effects.size(), 1U) << answer.sentence;
    EXPECT_EQ(answer.effects[0].name, "thrust_scale");
    EXPECT_EQ(answer.effects[0].of, "thruster.7");
    ASSERT_FALSE(answer.where.empty());
    EXPECT_EQ(answer.where[0].channel, "heave force");
    EXPECT_EQ(answer.where[0].unit, "N");
    const auto& estimate = answer.effects[0].parameters.at(0);
    EXPECT_NEAR(estimate.value, -0.3, 3 * estimate.std_error);
    ASSERT_TRUE(answer.gap.pooled.closed);
    EXPECT_GT(*answer.gap.pooled.closed, 0.8);
  }
}

TEST(SteadyRecording, ALoadIsNoWeakThruster) {
  config::Layout loaded = of_day(heavy_rov(), 61);
  loaded.body.mass_kg += 1;
  const auto answer = steady_diagnosis(hover(loaded, 61));
  EXPECT_NE(answer.verdict, gap::Verdict::no_gap) << answer.sentence;
  for (const gap::EffectFinding& effect : answer.effects)
    EXPECT_TRUE(effect.name == "weight" || effect.name == "buoyancy") << answer.sentence;
}

config::Layout weak(std::uint64_t day) {
  return changed(of_day(heavy_rov(), day), "thrust_scale", "thruster.7", {-0.2});
}

TEST(SteadyRecording, RecordingsOfOneSessionTellAsMuchAsOneAndThoseOfSeveralTellMore) {
  const auto alone = steady_diagnosis(hover(weak(51), 51));
  const auto session = steady_diagnosis(hover(weak(51), 51), {hover(weak(51), 52), hover(weak(51), 53)});
  const auto days = steady_diagnosis(hover(weak(51), 51), {hover(weak(52), 52), hover(weak(53), 53)});
  for (const gap::Diagnosis* answer : {&alone, &session, &days}) {
    ASSERT_FALSE(answer->candidates.empty());
    EXPECT_EQ(answer->candidates[0].words(), "thrust_scale of thruster.7") << answer->sentence;
  }
  const auto error = [](const gap::Diagnosis& answer) { return answer.candidates[0].parameters.at(0).std_error; };
  EXPECT_NEAR(error(session), error(alone), 0.1 * error(alone));
  EXPECT_LT(error(days), 0.95 * error(alone));
  EXPECT_TRUE(alone.recordings.empty());
  ASSERT_EQ(session.recordings.size(), 3U);
  ASSERT_EQ(session.differences.size(), 1U);
  EXPECT_EQ(session.differences[0].of, "thruster.7");
  EXPECT_FALSE(session.differences[0].differs);
  EXPECT_DOUBLE_EQ(session.duration_s, 3 * kDuration_s);
}

TEST(SteadyRecording, NominalRecordingsOfOneSessionTogetherHaveNoGap) {
  int flagged = 0;
  for (std::uint64_t day = 41; day < 45; ++day) {
    const config::Layout truth = of_day(heavy_rov(), day);
    const auto answer = steady_diagnosis(hover(truth, day), {hover(truth, day + 100), hover(truth, day + 200)});
    EXPECT_TRUE(answer.effects.empty()) << day << ": " << answer.sentence;
    if (answer.verdict != gap::Verdict::no_gap) ++flagged;
  }
  EXPECT_LE(flagged, 1) << "by chance about one in fifty";
}

TEST(SteadyRecording, OneOfSeveralThatCannotBeJudgedIsNamedAndLeftOut) {
  const RecordedMotion good = hover(weak(51), 51), short_one = hover(weak(51), 71, 0, 3);
  for (const bool is_first : {true, false}) {
    const auto answer = is_first ? steady_diagnosis(short_one, {good, good}) : steady_diagnosis(good, {short_one});
    EXPECT_EQ(answer.recordings.size(), is_first ? 2U : 0U);
    EXPECT_TRUE(std::ranges::any_of(
        answer.remarks, [](const std::string& remark) { return remark.starts_with("left out: hover 71: "); }));
    ASSERT_FALSE(answer.candidates.empty()) << answer.sentence;
  }
  EXPECT_NE(steady_diagnosis(short_one, {short_one}).sentence.find("at least 5 are needed"), std::string::npos);
}

TEST(SteadyRecording, AShortRecordingSaysWhatItLacks) {
  const auto answer = steady_diagnosis(hover(heavy_rov(), 71, 0, 3));
  EXPECT_EQ(answer.verdict, gap::Verdict::unknown);
  EXPECT_NE(answer.sentence.find("steady stretches of 1 s; at least 5 are needed"), std::string::npos)
      << answer.sentence;
}

TEST(SteadyRecording, TheBalanceOfATrueVehicleIsZeroWithinItsErrors) {
  const config::Layout layout = heavy_rov();
  const RecordedMotion recording = hover(layout, 81);
  const std::vector<std::string> none;
  const CauseLibrary library =
      steady_causes_of(layout, std::array{&recording}, causes_of(layout, recording, none));
  const auto power = SteadyRecording(layout, library, recording).power(Eigen::VectorXd::Zero(library.columns()));
  ASSERT_TRUE(power);
  EXPECT_LT(power->mean_square, 4);
}

TEST(Likelihood, StudentsTIsTheNormalDistributionForManyAndLessSureForFew) {
  const Likelihood departs{Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Zero(1), -3 - 18, -3, 1e9};
  EXPECT_NEAR(departs.evidence(), departs.value, 1e-3);
  Likelihood few = departs;
  few.freedom = 4;
  EXPECT_GT(few.evidence(), departs.evidence() + 10);
  EXPECT_LT(few.evidence(), few.norm);
}

}  // namespace
}  // namespace navcal::diagnosis

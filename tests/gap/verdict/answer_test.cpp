// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/answer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "gap/replay/regimes.h"
#include "tests/gap/prepared_mission.h"

namespace navcal::gap {
namespace {

bool says(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }
bool says(const std::vector<std::string>& texts, std::string_view part) {
  return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) { return says(text, part); });
}

/// A search that found motor_field, with hard_iron and gyro_scale as lesser candidates. No recording is behind it.
class FoundMotorField : public testing::Test {
 protected:
  FoundMotorField() {
    const auto count = static_cast<Eigen::Index>(library_.unknowns().size());
    ModelFit& best = result_.found.best;
    best.effects = {motor_};
    best.mean = Eigen::VectorXd::Zero(count);
    best.std = Eigen::VectorXd::Constant(count, 0.01);
    best.mean[library_.first(motor_)] = 0.8;
    best.linear.at = Eigen::VectorXd::Zero(count);
    best.linear.score = Eigen::VectorXd::Zero(count);
    best.linear.gram = Eigen::MatrixXd::Identity(count, count);
    for (Eigen::Index j = 0; j < count; ++j) {
      const double typical = library_.unknowns()[static_cast<std::size_t>(j)].typical;
      best.linear.gram(j, j) = 1000 / (typical * typical);
    }
    result_.priors = fit_spike_widths(library_, best.linear.gram, {});
    result_.found.candidates = {{{motor_}, 50, 0.95},
                                {{std::min(iron_, motor_), std::max(iron_, motor_)}, 47, 0.045},
                                {{gyro_}, 40, 0.004},
                                {{}, 0, 0.001}};
  }
  /// As hard_iron does when the current is constant.
  void make_regressors_equal(std::size_t one, std::size_t other) {
    Eigen::MatrixXd& gram = result_.found.best.linear.gram;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::Index a = library_.first(one) + i, b = library_.first(other) + i;
      gram(a, b) = gram(b, a) = 0.9999 * std::sqrt(gram(a, a) * gram(b, b));
    }
  }
  [[nodiscard]] Diagnosis findings(Verdict verdict) const {
    Diagnosis answer;
    answer.verdict = verdict;
    write_findings(result_, library_, answer);
    return answer;
  }

  const Library library_{{}};
  const std::size_t motor_ = test::index_of(library_, "motor_field"),
                    iron_ = test::index_of(library_, "hard_iron"), gyro_ = test::index_of(library_, "gyro_scale");
  FoundEffects result_{};
};

TEST_F(FoundMotorField, IsNamedWhenItExplains) {
  const Diagnosis answer = findings(Verdict::explained);
  ASSERT_EQ(answer.effects.size(), 1U);
  const EffectFinding& motor = answer.effects.front();
  EXPECT_EQ(motor.name, "motor_field");
  EXPECT_NEAR(motor.probability, 0.995, 1e-12) << "of all subsets that hold it";
  ASSERT_EQ(motor.parameters.size(), 3U);
  EXPECT_EQ(motor.parameters.front().name, "x_uT_per_A");
  EXPECT_EQ(motor.parameters.front().value, 0.8);
  EXPECT_EQ(motor.parameters.front().std_error, 0.01);
  EXPECT_EQ(motor.manoeuvre, library_[motor_].manoeuvre.text());
  EXPECT_TRUE(motor.confused_with.empty());
}

TEST_F(FoundMotorField, IsOnlyACandidateOfAnUnknownGap) {
  const Diagnosis answer = findings(Verdict::unknown);
  EXPECT_TRUE(answer.effects.empty());
  ASSERT_EQ(answer.candidates.size(), 2U) << "gyro_scale with 0.004 is not worth a line";
  EXPECT_EQ(answer.candidates[0].name, "motor_field");
  EXPECT_EQ(answer.candidates[1].name, "hard_iron");
  EXPECT_TRUE(answer.candidates[1].parameters.empty()) << "no member of the best subset";
}

TEST_F(FoundMotorField, ACandidateIsListedFromOnePercentOn) {
  result_.found.candidates[2].probability = 0.011;
  EXPECT_EQ(findings(Verdict::unknown).candidates.size(), 3U);
}

TEST_F(FoundMotorField, SumsOfRoundedProbabilitiesAreAtMostOne) {
  result_.found.candidates[0].probability = 0.9999999;
  EXPECT_EQ(findings(Verdict::explained).effects.front().probability, 1);
}

TEST_F(FoundMotorField, IsConfusedWithAnEffectOfTheSameRegressors) {
  make_regressors_equal(motor_, iron_);
  const Diagnosis answer = findings(Verdict::explained);
  const auto& confused = answer.effects.front().confused_with;
  ASSERT_EQ(confused.size(), 1U);
  EXPECT_EQ(confused.front().name, "hard_iron");
  EXPECT_TRUE(says(confused.front().tie_breaker, library_[motor_].manoeuvre.text()));
  EXPECT_TRUE(says(confused.front().tie_breaker, library_[iron_].manoeuvre.text()));
  EXPECT_LT(confused.front().separation_nats, 10);
}

TEST_F(FoundMotorField, IsNotConfusedWithAMemberOfTheSameSubset) {
  make_regressors_equal(motor_, iron_);
  result_.found.best.effects = {std::min(iron_, motor_), std::max(iron_, motor_)};
  for (const EffectFinding& effect : findings(Verdict::explained).effects) {
    EXPECT_TRUE(effect.confused_with.empty()) << effect.name;
  }
}

/// A mission whose every heading and surfacing is off by this much; nothing else was measured.
Comparison off_by(double heading_rad, double error_m, double after_factor) {
  Comparison made;
  const auto innovations = [&](double factor) {
    Innovations all;
    all.grid = Eigen::MatrixXd::Constant(2000, kChannels, std::numeric_limits<double>::quiet_NaN());
    all.grid.col(heading).setConstant(factor * heading_rad);
    all.fixes = Eigen::MatrixXd(0, kFixChannels);
    all.resurfacings = {{100, 200, factor * error_m}, {150, 10, 1e6}};
    return all;
  };
  made.nominal = innovations(1);
  made.improved = innovations(after_factor);
  for (std::vector<double>* each :
       {&made.course.time_s, &made.course.heading_rad, &made.course.roll_rad, &made.course.pitch_rad,
        &made.course.yaw_rate_rad_s, &made.course.pitch_rate_rad_s, &made.course.depth_m, &made.course.surge_m_s,
        &made.course.current_A, &made.course.temperature_rise_C, &made.course.rudder_rad,
        &made.course.elevator_rad, &made.course.shaft_rps})
    each->assign(2000, 0);
  for (std::size_t i = 0; i < 2000; ++i) made.course.time_s[i] = kInterval_s * static_cast<double>(i);
  made.channel_floor = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(reported_channels().size()), 0.001);
  return made;
}

TEST(WriteGap, SaysWhatItMeansForHeadingAndPosition) {
  Diagnosis answer;
  write_gap({off_by(0.1, 8, 0.25)}, {}, true, answer);
  ASSERT_TRUE(answer.gap.heading_error_rad);
  EXPECT_NEAR((*answer.gap.heading_error_rad)[0], 0.1, 1e-12);
  EXPECT_NEAR((*answer.gap.heading_error_rad)[1], 0.025, 1e-12);
  ASSERT_TRUE(answer.gap.dead_reckoning_m_per_100m);
  EXPECT_NEAR((*answer.gap.dead_reckoning_m_per_100m)[0], 4, 1e-12) << "10 m between surfacings do not count";
  EXPECT_NEAR((*answer.gap.dead_reckoning_m_per_100m)[1], 1, 1e-12);
  EXPECT_TRUE(answer.gap.held_out);
}

TEST(WriteGap, AChannelThatWasNotMeasuredIsNotReported) {
  Diagnosis answer;
  write_gap({off_by(0.1, 8, 0.25)}, {}, false, answer);
  ASSERT_EQ(answer.gap.channels.size(), 1U);
  EXPECT_EQ(answer.gap.channels.front().channel, "compass.heading");
  ASSERT_TRUE(answer.gap.channels.front().closure.closed);
  EXPECT_GT(*answer.gap.channels.front().closure.closed, 0.9);
}

TEST(WriteGap, NoClosureIsStatedOfWhatDoesNotStandClearOfTheFloor) {
  Diagnosis answer;
  Comparison small = off_by(0.1, 8, 0.25);
  small.channel_floor.setConstant(10);
  PooledClosure unclear{1.1, 1.0, 1.0, false, 0.5, 0.4, 0.6};
  write_gap({small}, unclear, true, answer);
  EXPECT_FALSE(answer.gap.pooled.closed);
  EXPECT_FALSE(answer.gap.pooled.closed_ci);
  ASSERT_EQ(answer.gap.channels.size(), 1U);
  EXPECT_FALSE(answer.gap.channels.front().closure.closed);
  unclear.clear = true;
  write_gap({small}, unclear, true, answer);
  EXPECT_EQ(answer.gap.pooled.closed, 0.5);
  EXPECT_EQ((*answer.gap.pooled.closed_ci)[1], 0.6);
}

TEST(WriteGap, WithoutMissionsNothingIsKnown) {
  Diagnosis answer;
  write_gap({}, {}, false, answer);
  EXPECT_TRUE(answer.gap.channels.empty());
  EXPECT_FALSE(answer.gap.heading_error_rad);
  EXPECT_FALSE(answer.gap.dead_reckoning_m_per_100m);
}

EffectFinding finding(std::string name, double probability) {
  EffectFinding made{std::move(name), probability, {}, {}};
  made.manoeuvre = "the manoeuvre of " + made.name;
  return made;
}

TEST(WriteWords, OfNoGapNameNothing) {
  Diagnosis answer;
  answer.verdict = Verdict::no_gap;
  answer.candidates = {finding("declination", 0.3)};
  write_words(answer);
  EXPECT_TRUE(answer.sentence.starts_with("No gap"));
  EXPECT_TRUE(answer.next.empty());
  EXPECT_TRUE(answer.unexplained.empty());
}

TEST(WriteWords, OfAnExplainedGapNameTheEffectsAndHowMuchGoesAway) {
  Diagnosis answer;
  answer.verdict = Verdict::explained;
  answer.effects = {finding("motor_field", 0.99), finding("gyro_scale", 0.93)};
  answer.effects[0].confused_with = {{"adc_droop", "step the current", 3}, {"hard_iron", "turn", 5}};
  answer.gap.held_out = true;
  answer.gap.pooled.closed = 0.984;
  answer.gap.pooled.closed_ci = {0.95, 1.01};
  write_words(answer);
  EXPECT_TRUE(says(answer.sentence, "motor_field and gyro_scale explain the gap (probability 0.93)"))
      << answer.sentence;
  EXPECT_TRUE(says(answer.sentence, "98 % of it goes away on missions held out")) << answer.sentence;
  EXPECT_TRUE(says(answer.next, "to tell motor_field from adc_droop: step the current"));
  EXPECT_FALSE(says(answer.next, "hard_iron")) << "the nearest one only";
  EXPECT_TRUE(answer.remarks.empty());
}

TEST(WriteWords, ClosureBeyondTheFloorIsSaid) {
  Diagnosis answer;
  answer.verdict = Verdict::explained;
  answer.effects = {finding("motor_field", 0.99)};
  answer.gap.pooled.closed = 1.2;
  answer.gap.pooled.closed_ci = {1.1, 1.3};
  write_words(answer);
  EXPECT_TRUE(says(answer.sentence, "motor_field explains the gap")) << answer.sentence;
  EXPECT_TRUE(says(answer.sentence, ": 100 % of it goes away.")) << answer.sentence;
  EXPECT_TRUE(says(answer.remarks, "the floor is too high"));
}

TEST(WriteWords, AGapTooSmallToMeasureHasNoShare) {
  Diagnosis answer;
  answer.verdict = Verdict::explained;
  answer.effects = {finding("motor_field", 0.99)};
  write_words(answer);
  EXPECT_TRUE(says(answer.sentence, "too small to say")) << answer.sentence;
  EXPECT_FALSE(says(answer.sentence, "%")) << answer.sentence;
}

TEST(WriteWords, OfAnUnknownGapAdviseTheManoeuvresOfLikelyCandidates) {
  Diagnosis answer;
  answer.verdict = Verdict::unknown;
  answer.candidates = {finding("fin_lag", 0.6), finding("fin_gain", 0.2), finding("buoyancy", 0.09)};
  write_words(answer);
  ASSERT_EQ(answer.next.size(), 2U);
  EXPECT_EQ(answer.next[0], "to see whether it is fin_lag: the manoeuvre of fin_lag");
  EXPECT_EQ(answer.next[1], "to see whether it is fin_gain: the manoeuvre of fin_gain");
  EXPECT_EQ(answer.unexplained.size(), 2U);
}

TEST(WriteWords, OfAnAmbiguousGapNameTheSetsAndWhatDecides) {
  Diagnosis answer;
  answer.alternatives = {{{finding("hard_iron", 0.6)}, 0.6, 0.98}, {{finding("motor_field", 0.4)}, 0.4, {}}};
  answer.alternatives[1].effects.push_back(answer.alternatives[0].effects[0]);
  write_unknown(UnknownKind::ambiguous, "", answer);
  EXPECT_EQ(
      answer.sentence,
      "Ambiguous: there is a gap, and hard_iron (probability 0.60, 98 % closed), or motor_field and hard_iron "
      "(probability 0.40) explains it.");
  EXPECT_EQ(answer.next, std::vector<std::string>{"to decide between hard_iron and motor_field + hard_iron: the "
                                                  "manoeuvre of motor_field"});
}

TEST(WriteWords, OutsideAndCannotSayAreTold) {
  Diagnosis answer;
  write_unknown(UnknownKind::outside, "hard_iron closes 3 %", answer);
  EXPECT_TRUE(says(answer.sentence, "Outside the library: there is a gap")) << answer.sentence;
  EXPECT_TRUE(says(answer.sentence, "explain it: hard_iron closes 3 %.")) << answer.sentence;
  write_unknown(UnknownKind::cannot_say, "GPS is missing", answer);
  EXPECT_EQ(answer.sentence, "Whether there is a gap cannot be said: GPS is missing.");
  answer.gap.pooled.closed = 0.1;
  write_unknown(UnknownKind::cannot_say, "GPS is missing", answer);
  EXPECT_EQ(answer.sentence, "The cause cannot be said: GPS is missing.");
}

TEST(WriteWords, WithoutALikelyCandidateANewEffectIsAdvised) {
  for (const double probability : {0.0, 0.19}) {
    Diagnosis answer;
    answer.verdict = Verdict::unknown;
    if (probability > 0) answer.candidates = {finding("fin_lag", probability)};
    write_words(answer);
    EXPECT_TRUE(says(answer.next, "add an effect"));
    EXPECT_EQ(answer.unexplained.empty(), probability == 0);
  }
}

}  // namespace
}  // namespace navcal::gap

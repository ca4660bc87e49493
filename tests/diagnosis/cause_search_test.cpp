// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/cause_search.h"

#include <gtest/gtest.h>

#include <random>

#include "diagnosis/limits.h"
#include "diagnosis/nominal_bank.h"
#include "sim/layout/effects/layout_effects.h"
#include "tests/identify/identification_case.h"

namespace navcal::diagnosis {
namespace {

/// Three causes of one column each; the third cannot be negative.
CauseLibrary small_library() {
  CauseLibrary library;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    library.causes.push_back(
        {.name = name,
         .of = {},
         .manoeuvre = {},
         .parameters = {{.name = "k", .low = i == 2 ? 0.0 : -10.0, .high = 10, .column = i}}});
  }
  return library;
}

ColumnPriors small_priors() { return {Eigen::VectorXd::Constant(3, kTolerance), Eigen::VectorXd::Constant(3, 1)}; }

/// Residuals of a known design with unit noise.
LinearRecording recording_of(const Eigen::VectorXd& truth, double noise, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd design = Eigen::MatrixXd::NullaryExpr(200, 3, [&] { return normal(random); });
  const Eigen::VectorXd residual =
      design * truth + noise * Eigen::VectorXd::NullaryExpr(200, [&] { return normal(random); });
  return {design.transpose() * design, design.transpose() * residual, residual.squaredNorm()};
}

TEST(SetEvidence, TheTrueSetWins) {
  const CauseLibrary library = small_library();
  const ColumnPriors priors = small_priors();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SetEvidence none(recording_of(Eigen::Vector3d(0, 0, 0), 1, seed), library, priors);
    const SetEvidence second(recording_of(Eigen::Vector3d(0, 0.8, 0), 1, seed), library, priors);
    const SetEvidence both(recording_of(Eigen::Vector3d(1, 0, 1), 1, seed), library, priors);
    for (const CauseSet& other : {CauseSet{0}, CauseSet{1}, CauseSet{2}, CauseSet{0, 1}})
      EXPECT_GT(none({}), none(other));
    for (const CauseSet& other : {CauseSet{}, CauseSet{0}, CauseSet{2}, CauseSet{0, 1}})
      EXPECT_GT(second({1}), second(other));
    for (const CauseSet& other : {CauseSet{}, CauseSet{0}, CauseSet{2}, CauseSet{0, 1}, CauseSet{1, 2}})
      EXPECT_GT(both({0, 2}), both(other));
  }
}

TEST(SetEvidence, DoesNotDependOnThePointOfLinearisation) {
  const CauseLibrary library = small_library();
  const ColumnPriors priors = small_priors();
  const LinearRecording about_zero = recording_of(Eigen::Vector3d(0.5, 0, 0.7), 1, 3);
  const LinearRecording there =
      about_zero.about(Eigen::Vector3d(0.4, -0.1, 0.6)).about(Eigen::Vector3d(-0.4, 0.1, -0.6));
  EXPECT_NEAR(there.power, about_zero.power, 1e-9 * about_zero.power);
  const SetEvidence a(about_zero, library, priors), b(there, library, priors);
  for (const CauseSet& set : {CauseSet{}, CauseSet{0}, CauseSet{0, 2}}) EXPECT_NEAR(a(set), b(set), 1e-6);
}

TEST(SetEvidence, ALagThatWouldBeNegativeIsNoCause) {
  const CauseLibrary library = small_library();
  const ColumnPriors priors = small_priors();
  const SetEvidence negative(recording_of(Eigen::Vector3d(0, 0, -0.8), 1, 5), library, priors);
  const SetEvidence of_two_signs(recording_of(Eigen::Vector3d(0, -0.8, 0), 1, 5), library, priors);
  EXPECT_LT(negative({2}), negative({}));
  EXPECT_GT(of_two_signs({1}), of_two_signs({}));
}

TEST(SetEvidence, ThePosteriorHoldsTheTruthAsOftenAsItSays) {
  const CauseLibrary library = small_library();
  const ColumnPriors priors = small_priors();
  int within = 0;
  constexpr int kCases = 200;
  for (int i = 0; i < kCases; ++i) {
    const SetEvidence evidence(recording_of(Eigen::Vector3d(0.6, 0, 0), 1, 100 + static_cast<std::uint64_t>(i)),
                               library, priors);
    const auto posterior = evidence.posterior({0});
    within += std::abs(posterior.mean[0] - 0.6) < posterior.std[0];
  }
  EXPECT_NEAR(within, 0.683 * kCases, 4 * std::sqrt(kCases * 0.683 * 0.317));
}

TEST(SetEvidence, TwinsAreNotSeparated) {
  const CauseLibrary library = small_library();
  const ColumnPriors priors = small_priors();
  LinearRecording twins = recording_of(Eigen::Vector3d(1, 0, 0), 1, 7);
  const LinearRecording apart = twins;
  twins.gram.row(1) = twins.gram.row(0);
  twins.gram.col(1) = twins.gram.col(0);
  twins.gram(1, 1) = twins.gram(0, 0);
  EXPECT_GT(SetEvidence(apart, library, priors).separation(0, {1}), 50);
  EXPECT_LT(SetEvidence(twins, library, priors).separation(0, {1}), 2);
}

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

TEST(Causes, AnExcludedEffectIsNowhereAndAnUnknownNameIsRefused) {
  const auto of = identify::vehicle_case("rov");
  const std::vector<std::string> excluded{"thrust_scale"};
  const CauseLibrary library = causes_of(of.prior, {}, excluded);
  for (const Cause& cause : library.causes) EXPECT_NE(cause.name, "thrust_scale");
  for (const identify::Parameter& parameter : library.parameters)
    EXPECT_EQ(parameter.name.find("thrust_scale"), std::string::npos);
  const std::vector<std::string> unknown{"thrust_scales"};
  EXPECT_THROW(static_cast<void>(causes_of(of.prior, {}, unknown)), std::invalid_argument);
}

TEST(NominalBank, SpikesAreAsWideAsNominalRecordingsScatterAndNeverNarrowerThanTheTolerance) {
  const CauseLibrary library = small_library();
  NominalBank bank;
  bank.estimates = {Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(0.5, 0, 0.001)};
  bank.powers = {1, 1};
  bank.channel_powers.resize(2);
  const ColumnPriors priors = widened(small_priors(), library, bank);
  EXPECT_GE(priors.spike[0], 0.5);
  EXPECT_LT(priors.spike[0], 1);
  EXPECT_EQ(priors.spike[1], kTolerance);
  EXPECT_EQ(priors.spike[2], kTolerance);
}

}  // namespace
}  // namespace navcal::diagnosis

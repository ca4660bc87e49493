// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/source_evidence.h"

#include <gtest/gtest.h>

#include "gap/sources/held_out_error.h"
#include "gap/thresholds.h"
#include "tests/gap/prepared_mission.h"

namespace navcal::gap {
namespace {

std::vector<const ErrorSource*> sources_named(const std::vector<std::string_view>& names) {
  std::vector<const ErrorSource*> some;
  for (const ErrorSource& source : error_sources()) {
    if (names.empty() || std::find(names.begin(), names.end(), source.name) != names.end())
      some.push_back(&source);
  }
  return some;
}

/// A short recording with these effects, and what its sources are found from.
class Recording {
 public:
  Recording(const Library& library, std::string_view effects, std::uint64_t seed, double seconds = 120)
      : prepared_(test::prepared_mission({"identification", effects, seconds, seed}, library, {24, 1, 2})),
        model_(prepared_->model(library, 2)), nominal_(linearise(model_, prepared_->at)),
        priors_(fit_spike_widths(library, prepared_->bank.gram, prepared_->bank.scores)),
        covariates_(covariates_of(prepared_->course)) {}

  [[nodiscard]] SourceProblem problem() const {
    return {model_, nominal_, priors_, covariates_, prepared_->course.time_s.front()};
  }
  [[nodiscard]] std::vector<SourceFit> fits(const std::vector<std::string_view>& names = {}) const {
    return SourceEvidence(problem()).ranked(sources_named(names), [](double) {});
  }
  [[nodiscard]] const Prepared& prepared() const { return *prepared_; }
  [[nodiscard]] const ResidualModel& model() const { return model_; }

 private:
  std::unique_ptr<Prepared> prepared_;
  ResidualModel model_;
  Linearised nominal_;
  Priors priors_;
  std::vector<Covariate> covariates_;
};

// The estimator moves each of these errors into channels of other instruments.
struct Cause {
  std::string_view effects, source;
};
class FindsTheSource : public testing::TestWithParam<Cause> {};

TEST_P(FindsTheSource, First) {
  const Library library({});
  const auto fits = Recording(library, GetParam().effects, 5).fits();
  ASSERT_FALSE(fits.empty());
  EXPECT_EQ(fits.front().source->name, GetParam().source);
  EXPECT_GT(fits.front().gain_nats, kObservable_nats);
  for (std::size_t i = 1; i < fits.size(); ++i) EXPECT_LE(fits[i].gain_nats, fits[i - 1].gain_nats);
}

INSTANTIATE_TEST_SUITE_P(OfEffects, FindsTheSource,
                         testing::Values(Cause{"[tilt_slosh]\ngain = 0.5\n", "compass.tilt"},
                                         Cause{"[gyro_scale]\nscale_az = 0.05\nscale_bz = 0.05\n", "imu.gyro"},
                                         Cause{"[fin_lag]\ntau_s = 0.3\n", "vehicle.moments"},
                                         Cause{"[depth_scale]\nscale = 0.1\n", "imu.depth"},
                                         Cause{"[motor_field]\nx_uT_per_A = 1\ny_uT_per_A = 1\n",
                                               "compass.field"}));

TEST(RankSources, OfAVehicleWithoutAGapNoneIsClear) {
  const Library library({});
  for (const SourceFit& fit : Recording(library, "", 6).fits()) {
    EXPECT_LT(fit.gain_nats, kObservable_nats) << fit.source->name;
  }
}

// Accelerometers, depth gauge and receiver share their replays with each other. Alone, each has its own.
TEST(RankSources, SharedReplaysGiveTheSameAsReplaysOfTheirOwn) {
  const Library library({});
  const Recording recording(library, "[depth_scale]\nscale = 0.1\n[accel_bias]\ny_m_s2 = 0.1\n", 7);
  const auto together = recording.fits({"imu.accel", "imu.depth", "gps"});
  ASSERT_GE(together.size(), 2U);
  for (const SourceFit& fit : together) {
    const auto alone = recording.fits({fit.source->name});
    ASSERT_EQ(alone.size(), 1U) << fit.source->name;
    EXPECT_NEAR(alone.front().gain_nats, fit.gain_nats, 5e-3 * std::abs(fit.gain_nats)) << fit.source->name;
  }
}

TEST(HeldOutError, TheErrorOfOneRecordingPredictsAnotherAndItsOwnMinutes) {
  const Library library({});
  constexpr std::string_view kEffect = "[depth_scale]\nscale = 0.1\n";
  const Recording first(library, kEffect, 5), second(library, kEffect, 8), without(library, "", 9);
  const auto fits = first.fits({"imu.depth"});
  ASSERT_EQ(fits.size(), 1U);
  const auto predicted = [&](const Recording& other) {
    return predict_other(fits, first.problem(), other.model(), other.prepared().at, other.prepared().course)
        .front();
  };
  const HeldOutError same = predicted(second), none = predicted(without),
                     minutes = predict_blocks(fits.front(), first.problem());
  EXPECT_GT(same.gain_nats, kObservable_nats);
  EXPECT_NEAR(same.gain_nats, (same.before - same.after) / 2, 1e-6);
  EXPECT_GT(minutes.gain_nats, kObservable_nats);
  // A vehicle that does not have the error is predicted worse with it.
  EXPECT_LT(none.gain_nats, -kObservable_nats);
}

}  // namespace
}  // namespace navcal::gap

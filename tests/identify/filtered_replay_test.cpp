// SPDX-License-Identifier: Apache-2.0
#include "identify/filter/filtered_replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "identify/filter/noise_fit.h"
#include "tests/identify/identification_case.h"

namespace navcal::identify {
namespace {

/// The micro vehicle, exactly as its layout says, with perfect instruments but for their noise.
struct FilterExample {
  VehicleCase of = vehicle_case("micro");
  RecordedMotion recording;
  FilterNoises noises;

  explicit FilterExample(double seconds) : recording(draw_recording(of, of.prior, seconds, 3, 0)) {
    noises.white.setConstant(1e-3);
    noises.coloured.setConstant(1e-2);
  }
  FilteredReplay filter() const { return {of.prior, uncertain_parameters(of.prior), recording, noises}; }
};

TEST(FilteredReplay, HeldGainsGiveThePassItself) {
  const FilterExample example(8);
  const FilteredReplay filter = example.filter();
  const auto pass = filter.follow(filter.start());
  ASSERT_TRUE(pass.has_value());
  EXPECT_LT((filter.replayed(*pass, pass->values) - pass->white()).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(filter.stretches(), 1U);
}

TEST(FilteredReplay, InnovationsOfTheTrueVehicleAreAsPredictedUnderFittedNoises) {
  const FilterExample example(20);
  FilteredReplay filter = example.filter();
  const auto pass = filter.follow(filter.start());
  ASSERT_TRUE(pass.has_value());
  const FollowedRecording followed{&filter, &*pass};
  const NoiseFit fit = fit_noises(std::span(&followed, 1), example.noises);
  filter.set_noises(fit.noises);
  const auto again = filter.follow(filter.start());
  ASSERT_TRUE(again.has_value());
  EXPECT_LT(again->cost(), pass->cost());
  EXPECT_NEAR(again->mean_square(), 1, 0.1);
  EXPECT_NEAR(fit.noises.factor[static_cast<std::size_t>(Channel::rate_z)], 1, 0.15);
  EXPECT_NEAR(fit.noises.factor[static_cast<std::size_t>(Channel::heading)], 1, 0.15);
  // The vehicle was not disturbed.
  EXPECT_LT(fit.noises.coloured[5], 0.05);
}

// On a real ship the sizes ran off one after the other, each step as short as the worst of them took, and the fit
// ended far from its goal: the noise power of nominal recordings was 0.43.
TEST(FitNoises, ComesToTheSameSizesFromFarAway) {
  FilterExample example(20);
  FilterNoises far;
  far.white *= 1e-4;
  far.coloured *= 1e3;
  far.factor.fill(0.03);
  const auto fit_from = [&](const FilterNoises& start) {
    const FilteredReplay filter = example.filter();
    const auto pass = filter.follow(filter.start());
    if (!pass) throw std::runtime_error("the vehicle cannot be followed");
    const FollowedRecording followed{&filter, &*pass};
    return fit_noises(std::span(&followed, 1), start).noises;
  };
  const FilterNoises near = fit_from({}), found = fit_from(far);
  for (const Channel channel : {Channel::rate_x, Channel::rate_z, Channel::heading}) {
    const auto at = static_cast<std::size_t>(channel);
    EXPECT_NEAR(found.factor[at], near.factor[at], 0.03 * near.factor[at]) << at;
  }
  // A channel that always reads the same tells nothing of its noise.
  constexpr auto kPitch = static_cast<std::size_t>(Channel::pitch);
  for (Reading& reading : example.recording.channels[kPitch]) reading.value = 0;
  EXPECT_EQ(fit_from(far).factor[kPitch], far.factor[kPitch]);
}

// To the first order of its lateness a heading was off by more than its noise wherever the vehicle began to turn.
TEST(FilteredReplay, ALateReadingIsPredictedWhereTheVehicleWas) {
  FilterExample example(20);
  const auto power = [&](double late_s) {
    const FilteredReplay filter = example.filter();
    Eigen::VectorXd values = filter.start();
    values[std::ssize(filter.parameters()) + static_cast<Eigen::Index>(Nuisance::heading_delay)] = late_s;
    const auto pass = filter.follow(values);
    if (!pass) return 1e9;
    const auto all = filter.neighbours(pass->readings, static_cast<std::size_t>(Channel::heading));
    return all.squares / all.count;
  };
  const double prompt = power(0);
  for (Reading& heading : example.recording.channels[static_cast<std::size_t>(Channel::heading)])
    heading.time_s += 0.2;
  EXPECT_GT(power(0), 4 * prompt);
  EXPECT_LT(power(0.2), 1.4 * prompt);
}

TEST(FilteredReplay, OtherNoisesNeedNoModel) {
  const FilterExample example(8);
  FilteredReplay filter = example.filter();
  const auto pass = filter.follow(filter.start());
  ASSERT_TRUE(pass.has_value());
  FilterNoises louder = example.noises;
  louder.white *= 3;
  louder.coloured *= 3;
  louder.tau_s = 10;
  louder.factor.fill(1.5);
  std::vector<FilterPass::Reading> again(pass->readings.size());
  filter.filter_again(*pass, louder, again);
  filter.set_noises(louder);
  const auto followed = filter.follow(filter.start());
  ASSERT_TRUE(followed.has_value());
  double apart = 0, size = 0;
  for (std::size_t i = 0; i < again.size(); ++i) {
    apart += std::pow(again[i].white - followed->readings[i].white, 2);
    size += std::pow(followed->readings[i].white - pass->readings[i].white, 2);
  }
  // All but a small part of what the noises change.
  EXPECT_LT(apart, 0.02 * size);
}

TEST(FilteredReplay, LinearisationPredictsTheInnovationsOfOtherValues) {
  const FilterExample example(12);
  const FilteredReplay filter = example.filter();
  const auto parameters = static_cast<Eigen::Index>(filter.parameters().size());
  const Eigen::Index bias = parameters + static_cast<Eigen::Index>(Nuisance::rate_bias_z);
  const auto pass = filter.follow(filter.start());
  ASSERT_TRUE(pass.has_value());
  Eigen::VectorXd values = filter.start();
  const std::vector<Eigen::Index> columns{0, parameters - 2, bias};
  const FilterLinearised linear = filter.linearise(*pass, columns);
  Eigen::VectorXd change(3);
  change << 0.005, 0.01, 0.001;
  for (std::size_t i = 0; i < columns.size(); ++i) values[columns[i]] += change[static_cast<Eigen::Index>(i)];
  const Eigen::VectorXd exact = filter.replayed(*pass, values) - linear.white;
  EXPECT_LT((linear.jacobian * change - exact).norm(), 0.05 * exact.norm());
  EXPECT_EQ(linear.count(), static_cast<Eigen::Index>(filter.readings().size()));
  EXPECT_DOUBLE_EQ(linear.power, pass->power());
}

/// The numbers of a layout, and all errors of instruments that the recording can have.
std::vector<Eigen::Index> all_columns(const FilteredReplay& filter) {
  std::vector<Eigen::Index> all;
  const auto parameters = std::ssize(filter.parameters());
  for (Eigen::Index i = 0; i < parameters + kNuisances; ++i) {
    if (i < parameters || filter.matters(static_cast<Nuisance>(i - parameters))) all.push_back(i);
  }
  return all;
}

/// Compares all columns at some values, the gains of the pass held, with differences of replays; returns how many.
int compare_columns(const FilterExample& example, const FilteredReplay& filter, const FilterPass& pass,
                    const Eigen::VectorXd& at_values) {
  const auto columns = all_columns(filter);
  const auto linear = filter.linearise(pass, at_values, columns);
  if (!linear) return 0;
  const auto parameters = std::ssize(filter.parameters());
  int compared = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Eigen::Index at = columns[c];
    const bool is_parameter = at < parameters;
    const double step = is_parameter ? 1e-3 * filter.parameters()[static_cast<std::size_t>(at)].prior_std
                        : is_delay(static_cast<Nuisance>(at - parameters))
                            ? 0.005
                            : 1e-3 * nuisance_stds(example.recording)[at - parameters];
    Eigen::VectorXd values = at_values;
    values[at] += step;
    const Eigen::VectorXd exact = (filter.replayed(pass, values) - linear->white) / step;
    if (exact.norm() < 1) continue;  // told by nothing but rounding
    const Eigen::VectorXd error = linear->jacobian.col(static_cast<Eigen::Index>(c)) - exact;
    EXPECT_LT(error.norm(), 0.06 * exact.norm()) << at;
    EXPECT_LT(std::abs(error.dot(linear->white)), 0.3 * exact.norm()) << "moves the estimate: " << at;
    ++compared;
  }
  return compared;
}

TEST(FilteredReplay, AColumnIsTheDifferenceOfTwoReplays) {
  const FilterExample example(12);
  const FilteredReplay filter = example.filter();
  const auto pass = filter.follow(filter.start());
  ASSERT_TRUE(pass.has_value());
  EXPECT_GT(compare_columns(example, filter, *pass, filter.start()), 30);
}

// A thruster at 60 % was "no gap": far from the values of the pass its derivatives are those of other forces, and
// columns that were made of them were wrong by half.
TEST(FilteredReplay, AColumnFarFromThePassIsTheDifferenceOfTwoReplays) {
  const FilterExample example(12);
  const FilteredReplay filter = example.filter();
  Eigen::VectorXd elsewhere = filter.start();
  for (Eigen::Index i = 0; i < std::ssize(filter.parameters()); ++i) {
    const Parameter& parameter = filter.parameters()[static_cast<std::size_t>(i)];
    if (parameter.name.find("force_scale") != std::string::npos) elsewhere[i] *= 0.6;
  }
  const auto pass = filter.follow(elsewhere);
  ASSERT_TRUE(pass.has_value());
  EXPECT_GT(compare_columns(example, filter, *pass, filter.start()), 30);
}

// A fifth of the instruments' errors that others planted were of these kinds, and none had a number.
TEST(FilteredReplay, LateReadingsAreThoseOfTheMotionBefore) {
  const VehicleCase rov = vehicle_case("rov");
  for (const Nuisance late : {Nuisance::imu_delay, Nuisance::heading_delay, Nuisance::doppler_delay}) {
    RecordedMotion recording = draw_recording(rov, rov.prior, 20, 3, 0);
    constexpr double kAge_s = 0.06;
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (delay_of(static_cast<Channel>(c)) != late) continue;
      for (Reading& reading : recording.channels[c]) reading.time_s += kAge_s;
    }
    FilterNoises noises;
    noises.white.setConstant(1e-3);
    noises.coloured.setConstant(1e-2);
    const FilteredReplay filter(rov.prior, {}, recording, noises);
    Eigen::VectorXd values = filter.start();
    const Eigen::Index at = values.size() - kNuisances + static_cast<Eigen::Index>(late);
    for (int round = 0; round < 3; ++round) {
      const auto pass = filter.follow(values);
      ASSERT_TRUE(pass.has_value());
      const std::vector<Eigen::Index> column{at};
      const FilterLinearised linear = filter.linearise(*pass, column);
      values[at] += linear.score()[0] / linear.information()(0, 0);
    }
    EXPECT_NEAR(values[at], kAge_s, 0.01) << nuisances()[static_cast<std::size_t>(late)].name;
  }
}

TEST(FilteredReplay, AStatedFieldIsWhereMagneticHeadingsBegin) {
  FilterExample example(8);
  set_field(example.recording, {15, 5, 40});
  const double declination_rad = std::atan2(5, 15);
  const auto offset = static_cast<Eigen::Index>(Nuisance::heading_offset);
  const auto begin = [&] { return example.filter().start().tail<kNuisances>()[offset]; };
  EXPECT_DOUBLE_EQ(begin(), -declination_rad);
  EXPECT_LT(nuisance_stds(example.recording)[offset], 0.1);
  EXPECT_NEAR(example.recording.dip_rad, std::atan2(40, std::hypot(15, 5)), 1e-12);
  example.recording.heading_is_true = true;
  EXPECT_EQ(begin(), 0);
  EXPECT_GT(nuisance_stds(RecordedMotion{})[offset], 0.3);
}

// A dead band of 3 % that no command between it and 6 % told: its slope was zero there, and its estimate lost.
TEST(FilteredReplay, AnEffectThatHasNoSlopeWhereItIsHasItFromZero) {
  const FilterExample example(8);
  Parameter half{"share", {}, 0, 1, 0, 10, {}, {}, {}, 1};
  half.change = [](config::Layout& layout, double value) {
    layout.thrusters[0].force_scale *= value > 0 ? 0.98 : 1;
  };
  std::vector<Parameter> parameters{half};
  const FilteredReplay filter(example.of.prior, parameters, example.recording, example.noises);
  Eigen::VectorXd values = filter.start();
  values[0] = 2;
  const auto pass = filter.follow(values);
  ASSERT_TRUE(pass.has_value());
  const std::vector<Eigen::Index> column{0};
  const FilterLinearised linear = filter.linearise(*pass, column);
  const Eigen::VectorXd at_zero = filter.replayed(*pass, filter.start());
  const Eigen::VectorXd from_zero = linear.white - at_zero;
  EXPECT_GT(from_zero.norm(), 0.1);
  EXPECT_LT((2 * linear.jacobian - from_zero).norm(), 0.05 * from_zero.norm());
}

TEST(FilteredReplay, NuisancesOfAbsentInstrumentsDoNotMatter) {
  const FilterExample example(6);
  const FilteredReplay filter = example.filter();
  EXPECT_TRUE(filter.matters(Nuisance::rate_bias_x));
  EXPECT_TRUE(filter.matters(Nuisance::gauge_offset));
  EXPECT_FALSE(filter.matters(Nuisance::doppler_scale));
  EXPECT_FALSE(filter.matters(Nuisance::current_north));
}

TEST(FilteredReplay, ASilenceStartsItAnew) {
  FilterExample example(24);
  for (auto& channel : example.recording.channels)
    std::erase_if(channel, [](const Reading& reading) { return reading.time_s > 6 && reading.time_s < 18; });
  const FilteredReplay filter = example.filter();
  EXPECT_EQ(filter.stretches(), 2U);
  const auto pass = filter.follow(filter.start());
  ASSERT_TRUE(pass.has_value());
  EXPECT_LT(pass->white().cwiseAbs().maxCoeff(), 10);
}

TEST(FilteredReplay, TheFirstThreeSecondsBehindAStartAreNoEvidence) {
  FilterExample example(24);
  for (auto& channel : example.recording.channels)
    std::erase_if(channel, [](const Reading& reading) { return reading.time_s > 6 && reading.time_s < 18; });
  const FilteredReplay filter = example.filter();
  const auto pass = filter.follow(filter.start());
  ASSERT_TRUE(pass.has_value());
  const double begin_s = filter.readings().front().time_s;
  for (std::size_t i = 0; i < pass->readings.size(); ++i) {
    const double time_s = filter.readings()[i].time_s;
    const bool is_first = time_s < begin_s + 3 || (time_s >= 18 && time_s < 21);
    if (std::abs(time_s - 21) < 0.1) continue;  // the first reading is not at 18 s exactly
    EXPECT_EQ(pass->readings[i].is_settling, is_first) << time_s;
    EXPECT_EQ(pass->readings[i].white == 0, is_first) << time_s;
  }
}

// A filter that began with no idea of the speed took drag for tilt, and was sure of it for seconds: a nominal
// vehicle was named for the scale of its pitch gyro, stated to 0.017 and wrong by 0.27.
TEST(FilteredReplay, AVehicleThatIsUnderWayAtTheStartIsFollowedAsWellAsLater) {
  const FilterExample example(120);
  double power = 0, count = 0;
  for (double from_s = 5; from_s < 110; from_s += 7) {
    const RecordedMotion recording = part_of(example.recording, from_s, from_s + 8);
    const FilteredReplay filter(example.of.prior, {}, recording, example.noises);
    const auto pass = filter.follow(filter.start());
    ASSERT_TRUE(pass.has_value());
    power += pass->power();
    count += pass->count();
  }
  EXPECT_NEAR(power / count, 1, 0.05);
}

TEST(FilteredReplay, AStretchThatDivergesIsLeftOutAndCounted) {
  FilterExample example(24);
  // For half a second the pitch stands still at a right angle.
  for (Reading& reading : example.recording.channels[static_cast<std::size_t>(Channel::pitch)])
    if (reading.time_s > 10 && reading.time_s < 10.5) reading = {reading.time_s, 1.57, 1e-5};
  FilteredReplay filter = example.filter();
  EXPECT_FALSE(filter.follow(filter.start()).has_value());
  EXPECT_GE(filter.leave_out_diverging(filter.start()), 1U);
  EXPECT_GE(filter.stretches(), 2U);
  const auto pass = filter.follow(filter.start());
  ASSERT_TRUE(pass.has_value());
  EXPECT_LT(pass->mean_square(), 3);
}

}  // namespace
}  // namespace navcal::identify

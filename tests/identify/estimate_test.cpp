// SPDX-License-Identifier: Apache-2.0
#include "identify/fit/estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "identify/answer/identification.h"
#include "tests/identify/identification_case.h"

namespace navcal::identify {
namespace {

const FitProgress kSilent = [](auto, auto) {};

TEST(IdentifyEstimate, ErrorsAreAsStated) {
  const VehicleCase of = vehicle_case("micro");
  const DrawnVehicle drawn = draw_vehicle(of, 5);
  const std::vector<RecordedMotion> recordings{draw_recording(of, drawn.layout, 24, 6)};
  PredictionErrorProblem problem(of.prior, uncertain_parameters(of.prior), recordings, {});
  const Estimate found = estimate(problem, kSilent);
  double sum = 0;
  for (Eigen::Index i = 0; i < drawn.truth.size(); ++i) {
    const double error = (found.unknowns[i] - drawn.truth[i]) / found.stds[i];
    EXPECT_LT(std::abs(error), 4) << problem.parameters()[static_cast<std::size_t>(i)].name;
    sum += error * error;
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(drawn.truth.size())), 1.6);
}

/// Without the coloured disturbance they come out at 0.3 to 0.4 of the truth: the controller's commands cancel it.
TEST(IdentifyEstimate, ForcesOfASteeredVehicleDoNotCollapse) {
  const VehicleCase of = vehicle_case("ferry");
  config::Layout truth = of.prior;
  for (auto& thruster : truth.thrusters) thruster.force_scale = 1;
  const auto parameters = uncertain_parameters(of.prior);
  const std::vector<RecordedMotion> recordings{draw_steered(truth, 120, 1)};
  PredictionErrorProblem problem(of.prior, parameters, recordings, {});
  const Estimate found = estimate(problem, kSilent);
  const Eigen::VectorXd values = found.unknowns.head(std::ssize(parameters));
  const Eigen::Vector3d forces = force_over_mass(with_values(of.prior, parameters, values), truth);
  EXPECT_LT(std::abs(values[2] - 1) / found.stds[2], 3);
  EXPECT_GT(forces.minCoeff(), 0.75) << forces.transpose();
  EXPECT_LT(forces.maxCoeff(), 1.15) << forces.transpose();
}

TEST(Identify, ThinnedReadingsAreOneInAnInterval) {
  const VehicleCase of = vehicle_case("micro");
  const RecordedMotion all = draw_recording(of, of.prior, 8, 3);
  const RecordedMotion thin = thinned(all, 1);
  for (std::size_t c = 0; c < kChannels; ++c) {
    EXPECT_EQ(thin.channels[c].empty(), all.channels[c].empty());
    for (std::size_t i = 1; i < thin.channels[c].size(); ++i)
      EXPECT_GE(thin.channels[c][i].time_s, thin.channels[c][i - 1].time_s + 1 - 1e-3);
  }
  EXPECT_EQ(thinned(all, 0)[Channel::rate_x].size(), all[Channel::rate_x].size());
}

/// A small problem: the micro vehicle with a few uncertain numbers.
IdentifyRequest small_request(double seconds) {
  VehicleCase of = vehicle_case("micro");
  of.prior.uncertainties.resize(1);
  IdentifyRequest request;
  request.prior = of.prior;
  request.advise = false;
  DrawnVehicle drawn = draw_vehicle(of, 1);
  request.recordings.push_back(draw_recording(of, drawn.layout, seconds, 2));
  return request;
}

TEST(Identify, MissingCommandsAreSaid) {
  IdentifyRequest request = small_request(8);
  request.recordings[0].signals.erase("output2");
  try {
    (void)identify(request, kSilent);
    FAIL();
  } catch (const std::invalid_argument& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("commands are missing: thruster"), std::string::npos) << words;
    EXPECT_NE(words.find("needs output2; the recording has output1, output3, output4"), std::string::npos)
        << words;
  }
}

TEST(Identify, ALayoutWithoutUncertainNumbersIsSaid) {
  IdentifyRequest request = small_request(8);
  request.prior.uncertainties.clear();
  EXPECT_THROW((void)identify(request, kSilent), std::invalid_argument);
}

TEST(Identify, LateCommandsAreSaid) {
  IdentifyRequest request = small_request(16);
  for (auto& [name, signal] : request.recordings[0].signals)
    for (double& time_s : signal.times_s) time_s -= 0.2;
  const Identification found = identify(request, kSilent);
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings[0].find("the vehicle follows its commands 0.2"), std::string::npos)
      << found.warnings[0];
}

TEST(Identify, SaturatedCommandsAreSaid) {
  IdentifyRequest request = small_request(8);
  for (double& value : request.recordings[0].signals["output1"].values) value = request.prior.thrusters[0].high;
  const PredictionErrorProblem problem(request.prior, uncertain_parameters(request.prior), request.recordings, {});
  const auto words = problem.oddities();
  ASSERT_EQ(words.size(), 1U);
  EXPECT_NE(words[0].find("saturated: output1 stands at a limit 100 % of the time"), std::string::npos)
      << words[0];
}

TEST(Identify, HeldOutRecordingsJudge) {
  IdentifyRequest request = small_request(12);
  VehicleCase of = vehicle_case("micro");
  of.prior.uncertainties.resize(1);
  request.held_out.push_back(draw_recording(of, draw_vehicle(of, 1).layout, 8, 9));
  const Identification found = identify(request, kSilent);
  ASSERT_TRUE(found.held_out.has_value());
  EXPECT_LT(found.held_out->after, found.held_out->before);
  EXPECT_TRUE(found.predictions.empty()) << "no velocity is measured";
}

TEST(Identify, PredictionsOfHeldOutRecordingsAreComparedWithThoseOfTheFile) {
  VehicleCase of = vehicle_case("rov");
  const config::Layout truth = draw_vehicle(of, 1).layout;
  of.prior.uncertainties.resize(1);
  IdentifyRequest request;
  request.prior = of.prior;
  request.advise = false;
  request.recordings = {draw_recording(of, truth, 20, 5)};
  request.held_out = {draw_recording(of, truth, 30, 9)};
  const Identification found = identify(request, kSilent);
  ASSERT_FALSE(found.predictions.empty());
  const PredictionFit& velocity = found.predictions.front();
  EXPECT_EQ(velocity.quantity, "velocity");
  EXPECT_EQ(velocity.after_s, 1);
  EXPECT_GE(velocity.starts, 5U);
  EXPECT_GT(velocity.after, 0);
  EXPECT_LT(velocity.after, 1.5 * velocity.before);
  EXPECT_TRUE(velocity.linear.has_value());
}

}  // namespace
}  // namespace navcal::identify

// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/model_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gap/inference/subset_evidence.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

/// Straight lines about nothing, with everything at `truth`.
Linearised made_up(const Library& library, const Eigen::VectorXd& truth, double noise = 0.2) {
  std::mt19937_64 dice(5);
  std::normal_distribution<double> normal;
  Linearised linear;
  linear.at = Eigen::VectorXd::Zero(truth.size());
  linear.design.resize(400, truth.size());
  for (Eigen::Index j = 0; j < linear.design.cols(); ++j) {
    for (Eigen::Index i = 0; i < linear.design.rows(); ++i) {
      linear.design(i, j) = normal(dice) / library.unknowns()[static_cast<std::size_t>(j)].typical;
    }
  }
  linear.residual = linear.design * truth;
  for (double& each : linear.residual) each += noise * normal(dice);
  linear.gram = linear.design.transpose() * linear.design;
  linear.score = linear.design.transpose() * linear.residual;
  return linear;
}

class Explained : public testing::Test {
 protected:
  Explained() {
    const auto count = static_cast<Eigen::Index>(library_.unknowns().size());
    truth_ = Eigen::VectorXd::Zero(count);
    priors_ = fit_spike_widths(library_, Eigen::MatrixXd::Identity(count, count), {});
    for (std::size_t e = 0; e < library_.size(); ++e) {
      if (library_[e].name == "gps_latency") lag_ = e;
      if (library_[e].name == "hard_iron") iron_ = e;
    }
  }
  const Library library_{{}};
  Eigen::VectorXd truth_;
  Priors priors_;
  std::size_t lag_ = 0, iron_ = 0;
};

TEST_F(Explained, ALagBelowZeroIsNoMeritOfTheSetThatHoldsIt) {
  truth_[library_.first(lag_)] = -0.3;
  const Linearised linear = made_up(library_, truth_);
  const double with_lag = bound_penalty_nats({lag_}, linear, library_, priors_);
  EXPECT_GT(with_lag, 10);
  EXPECT_GE(
      bounded_posterior(linear, library_, priors_, parameter_indices(library_, {lag_})).mean[library_.first(lag_)],
      -1e-6);
}

TEST_F(Explained, WhatIsPossibleCostsNothing) {
  for (Eigen::Index j = Library::kBiases; j < truth_.size(); ++j) {
    truth_[j] = 0.02 * library_.unknowns()[static_cast<std::size_t>(j)].typical;
  }
  const Linearised linear = made_up(library_, truth_, 0);
  for (const EffectSubset& set :
       {EffectSubset{}, EffectSubset{lag_}, EffectSubset{std::min(lag_, iron_), std::max(lag_, iron_)}}) {
    EXPECT_NEAR(bound_penalty_nats(set, linear, library_, priors_), 0, 0.01);
  }
}

TEST_F(Explained, TheImpossibleIsNeverCheaper) {
  std::mt19937_64 dice(11);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 20; ++round) {
    for (Eigen::Index j = Library::kBiases; j < truth_.size(); ++j) {
      truth_[j] = 0.1 * normal(dice) * library_.unknowns()[static_cast<std::size_t>(j)].typical;
    }
    EXPECT_GE(bound_penalty_nats({iron_}, made_up(library_, truth_), library_, priors_), -1e-6);
  }
}

// On a straight course straight lines promised a shorter latency; simulation refused the step, and it was answered
// all the same.
TEST_F(Explained, AStepThatSimulationRefusesIsNotTheAnswer) {
  const Mission mission = test::simulated_mission("survey", "[hard_iron]\nx_uT = 2\n", 60, 6);
  const config::VehicleSettings vehicle;
  const Replay replay(mission, vehicle);
  const Whitening whitening = Whitening::nominal();
  const Linearised honest = linearise(replay, library_, whitening, truth_, 2);
  const Eigen::Index x = library_.first(iron_);
  const ModelFit found = refine({iron_}, honest, replay, library_, whitening, priors_);
  EXPECT_NEAR(found.mean[x], 2, 0.2);
  Linearised lying = honest;
  lying.design *= -1;
  lying.score *= -1;
  const ModelFit misled = refine({iron_}, lying, replay, library_, whitening, priors_);
  EXPECT_EQ(misled.mean, lying.at);
  EXPECT_LT(misled.log_odds, found.log_odds - 1000);
}

// An effect that the mission hardly shows may take the part of another effect, and so win as a member of any set.
TEST_F(Explained, WhatIsAllowedForGainsNothingByBeingNamed) {
  for (Eigen::Index j = 0; j < library_.count(iron_); ++j) {
    const auto unknown = static_cast<std::size_t>(library_.first(iron_) + j);
    truth_[library_.first(iron_) + j] = 4 * library_.unknowns()[unknown].typical;
  }
  const Linearised linear = made_up(library_, truth_);
  const SubsetEvidence as_usual(linear, library_, priors_);
  EXPECT_GT(as_usual({iron_}), as_usual({}) + 100);
  const Priors freed = as_nuisance_parameters(priors_, library_, {iron_});
  const SubsetEvidence allowed(linear, library_, freed);
  EXPECT_LT(allowed({iron_}), allowed({}));
  const Eigen::Index x = library_.first(iron_);
  EXPECT_NEAR(bounded_posterior(linear, library_, freed, {}).mean[x], truth_[x], 0.1 * std::abs(truth_[x]));
}

}  // namespace
}  // namespace navcal::gap

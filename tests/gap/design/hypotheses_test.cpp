// SPDX-License-Identifier: Apache-2.0
#include "gap/design/hypotheses.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

namespace navcal::gap {
namespace {

class Forecast : public testing::Test {
 protected:
  Forecast() : library_(std::vector<std::string>{}) {
    const auto n = static_cast<Eigen::Index>(library_.unknowns().size());
    priors_.slab.resize(n);
    for (Eigen::Index j = 0; j < n; ++j)
      priors_.slab[j] = library_.unknowns()[static_cast<std::size_t>(j)].typical;
    priors_.spike = 0.05 * priors_.slab;
    priors_.model_error = Eigen::VectorXd::Zero(n);
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    design_.resize(kRows, n);
    for (Eigen::Index i = 0; i < kRows; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) design_(i, j) = normal(random) / priors_.slab[j];
    }
  }
  [[nodiscard]] Eigen::MatrixXd covariance(const EffectSubset& members) const {
    Eigen::VectorXd prior = priors_.spike;
    for (const Eigen::Index j : parameter_indices(library_, members)) prior[j] = priors_.slab[j];
    const Eigen::MatrixXd scaled = design_ * prior.asDiagonal();
    return Eigen::MatrixXd::Identity(kRows, kRows) + scaled * scaled.transpose();
  }
  [[nodiscard]] ModelForecast forecast(const EffectSubset& members) const {
    return {members, design_.transpose() * design_, library_, priors_};
  }

  static constexpr Eigen::Index kRows = 120;
  Library library_;
  Priors priors_;
  Eigen::MatrixXd design_;
};

TEST_F(Forecast, IsTheExpectedLogEvidenceOfTheGaussianModels) {
  const EffectSubset a{3}, b{7};
  Eigen::VectorXd values = Eigen::VectorXd::Zero(priors_.spike.size());
  for (const Eigen::Index j : parameter_indices(library_, a)) values[j] = 0.7 * priors_.slab[j];
  const Eigen::MatrixXd of_a = covariance(a), of_b = covariance(b), tolerances = covariance({});
  const Eigen::VectorXd mean = design_ * values;
  const auto log_evidence = [&](const Eigen::MatrixXd& of) {
    const Eigen::LLT<Eigen::MatrixXd> factor(of);
    return -factor.matrixLLT().diagonal().array().log().sum() -
           0.5 * (mean.dot(factor.solve(mean)) + factor.solve(tolerances).trace());
  };
  EXPECT_NEAR(forecast(a).expected_over(forecast(b), values), log_evidence(of_a) - log_evidence(of_b), 1e-6);
}

TEST_F(Forecast, OfAModelOverItselfIsZero) {
  const Eigen::VectorXd values = priors_.slab;
  EXPECT_NEAR(forecast({2}).expected_over(forecast({2}), values), 0, 1e-9);
}

TEST_F(Forecast, ASimplerTrueModelWinsByItsOccamFactor) {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(priors_.spike.size());
  EXPECT_GT(forecast({}).expected_over(forecast({4}), nothing), 0.5);
}

TEST(ProbabilityOfExactAnswer, GrowsWithTheSeparation) {
  const std::vector<Hypothesis> two{{{0}, 1, 0.6, {}}, {{1}, 0.6, 0.4, {}}};
  double before = 0;
  for (const double nats : {0.0, 1.0, 4.0, 10.0, 40.0}) {
    const double probability = probability_of_exact_answer(two, Eigen::MatrixXd::Constant(2, 2, nats));
    EXPECT_GE(probability, before) << nats;
    before = probability;
  }
  EXPECT_GT(before, 0.99);
}

TEST(ProbabilityOfExactAnswer, DecidesNothingWithoutSeparation) {
  const std::vector<Hypothesis> two{{{0}, 0.1, 0.52, {}}, {{1}, 0, 0.48, {}}};
  EXPECT_EQ(probability_of_exact_answer(two, Eigen::MatrixXd::Zero(2, 2)), 0);
}

TEST(ProbabilityOfExactAnswer, AsksForMoreAgainstNoEffectThanAgainstARival) {
  const Eigen::MatrixXd little = Eigen::MatrixXd::Constant(2, 2, 2);
  const std::vector<Hypothesis> rivals{{{0}, 2, 1, {}}, {{1}, 0, 0, {}}}, none{{{0}, 2, 1, {}}, {{}, 0, 0, {}}};
  EXPECT_GT(probability_of_exact_answer(rivals, little), probability_of_exact_answer(none, little) + 0.2);
}

TEST(WeakHypotheses, HaveTheirStrengthWhateverTheNumberOfParameters) {
  const Library library(std::vector<std::string>{});
  Priors priors;
  priors.spike = priors.slab = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(library.unknowns().size()));
  const auto all = weak_hypotheses(library, priors, 0.2);
  ASSERT_EQ(all.size(), library.size() + 1);
  EXPECT_TRUE(all.front().effects.empty());
  for (std::size_t i = 1; i < all.size(); ++i) {
    double square = 0;
    for (const Eigen::Index j : parameter_indices(library, all[i].effects)) {
      square += std::pow(all[i].values[j] / library.unknowns()[static_cast<std::size_t>(j)].typical, 2);
    }
    EXPECT_NEAR(std::sqrt(square), 0.2, 1e-12);
  }
}

}  // namespace
}  // namespace navcal::gap

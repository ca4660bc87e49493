// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/spike_and_slab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gap/nulls/null_mission.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

constexpr Eigen::Index kMissions = 100;

/// A bank in which every unknown shows clearly and like none other, and scatters as `scatter` says (typical
/// values).
class MadeUpBank {
 public:
  MadeUpBank(const Library& library, const Eigen::VectorXd& scatter) {
    const Eigen::Index n = scatter.size();
    std::mt19937_64 dice(1);
    std::normal_distribution<double> normal;
    gram_ = Eigen::MatrixXd::Zero(n, n);
    scores_.resize(n, kMissions);
    for (Eigen::Index j = 0; j < n; ++j) {
      // One mission tells each to a hundredth of its typical value.
      const double typical = library.unknowns()[static_cast<std::size_t>(j)].typical;
      gram_(j, j) = 1e4 / (typical * typical);
      for (Eigen::Index i = 0; i < kMissions; ++i) {
        scores_(j, i) = gram_(j, j) * scatter[j] * typical * normal(dice) + std::sqrt(gram_(j, j)) * normal(dice);
      }
    }
  }
  [[nodiscard]] Priors priors(const Library& library) const { return fit_spike_widths(library, gram_, scores_); }

 private:
  Eigen::MatrixXd gram_, scores_;
};

Eigen::Index unknown_of(const Library& library, std::string_view effect) {
  for (std::size_t e = 0; e < library.size(); ++e) {
    if (library[e].name == effect) return library.first(e);
  }
  return -1;
}

Eigen::VectorXd everywhere(const Library& library, double scatter) {
  return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(library.unknowns().size()), scatter);
}

TEST(Spikes, AreTheScatterOfTheBankButNoLessThanItsTolerance) {
  const Library library({});
  Eigen::VectorXd scatter = everywhere(library, 0);
  const Eigen::Index wide = unknown_of(library, "hard_iron"), narrow = unknown_of(library, "declination");
  scatter[wide] = 0.1;
  const Priors priors = MadeUpBank(library, scatter).priors(library);
  EXPECT_NEAR(priors.spike[wide] / priors.slab[wide], 0.1, 0.02);
  EXPECT_DOUBLE_EQ(priors.spike[narrow], kTolerance * priors.slab[narrow]);
}

TEST(Spikes, WhatTheBankScattersBeyondItsTolerancesIsTheModelsError) {
  const Library library({});
  Eigen::VectorXd scatter = everywhere(library, kTolerance);
  const Eigen::Index poor = unknown_of(library, "gyro_nonlinearity"), exact = unknown_of(library, "soft_iron");
  scatter[poor] = 0.1;
  const Priors priors = MadeUpBank(library, scatter).priors(library);
  EXPECT_NEAR(priors.model_error[poor] / priors.slab[poor], std::sqrt(0.01 - kTolerance * kTolerance), 0.02);
  EXPECT_LT(priors.model_error[exact] / priors.slab[exact], 0.6 * kTolerance);
  EXPECT_EQ(priors.model_error.head<Library::kBiases>().norm(), 0);
}

// A compass's or a receiver's lag needs no fins to be seen: known no better, one of a tenth of its typical value
// was never found. A card that answers late looks like fins that were ordered earlier: known better, 5 ms of it
// were named beside four single effects of nineteen on straight courses.
TEST(Spikes, WhatTheInstantsOfOrdersDecideIsKnownNoBetterThanThey) {
  const Library library({});
  const Priors priors = MadeUpBank(library, everywhere(library, 0)).priors(library);
  for (const char* lag : {"fin_lag", "imu_latency"}) {
    const Eigen::Index j = unknown_of(library, lag);
    EXPECT_GE(priors.model_error[j], 0.005) << lag;
    EXPECT_GE(priors.spike[j], 0.005) << lag;
  }
  for (const char* lag : {"compass_lag", "gps_latency"}) {
    const Eigen::Index j = unknown_of(library, lag);
    EXPECT_LT(priors.spike[j], 1.5 * kTolerance * priors.slab[j]) << lag;
  }
}

TEST(Spikes, WhatIsExcludedIsAsGoodAsNothing) {
  const std::vector<std::string> excluded{"hard_iron"};
  const Library library(excluded);
  const Priors priors = MadeUpBank(library, everywhere(library, 0.1)).priors(library);
  const Eigen::Index j = unknown_of(library, "hard_iron");
  EXPECT_LT(priors.spike[j], 1e-6);
  EXPECT_LT(priors.slab[j], 1e-6);
  EXPECT_EQ(priors.model_error[j], 0);
}

}  // namespace
}  // namespace navcal::gap

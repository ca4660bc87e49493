// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/blocks.h"

#include <gtest/gtest.h>

#include <random>

namespace navcal::gap {
namespace {

/// Ten minutes in which every unknown shows like noise of its own, none like another, and clearly.
struct MadeUp {
  explicit MadeUp(double strength) {
    const auto unknowns = static_cast<Eigen::Index>(library.unknowns().size());
    layout.intervals = 1200;
    std::mt19937_64 dice(1);
    std::normal_distribution<double> normal;
    linear.at = Eigen::VectorXd::Zero(unknowns);
    linear.design =
        Eigen::MatrixXd::NullaryExpr(layout.intervals * kEvidenceChannels, unknowns, [&] { return normal(dice); });
    priors.slab.resize(unknowns);
    for (Eigen::Index j = 0; j < unknowns; ++j) {
      priors.slab[j] = library.unknowns()[static_cast<std::size_t>(j)].typical;
      linear.design.col(j) /= priors.slab[j];
    }
    priors.spike = 0.03 * priors.slab;
    const std::size_t effect = 5;
    effects = {effect};
    Eigen::VectorXd values = Eigen::VectorXd::Zero(unknowns);
    const auto member = parameter_indices(library, effects).front();
    values[member] = strength * priors.slab[member];
    linear.residual = linear.design * values;
    for (double& each : linear.residual) each += normal(dice);
  }
  [[nodiscard]] std::vector<double> gains() const {
    return gains_of_blocks(effects, {linear, library, priors}, layout);
  }

  Library library{{}};
  EffectSubset effects;
  Linearised linear;
  Priors priors;
  Layout layout;
};

TEST(Blocks, AnEffectThatIsThereForetellsTheOtherHalf) {
  for (const double gain : MadeUp(1).gains()) EXPECT_GT(gain, 1000);
}

// A fifth of the usual strength is six times what tolerance allows; but data this clear would make it a fifth by
// that tolerance, too, and leave nothing to be gained.
TEST(Blocks, ASmallOneIsNotTakenForTolerance) {
  for (const double gain : MadeUp(0.2).gains()) EXPECT_GT(gain, 50);
}

TEST(Blocks, OneThatIsNotThereForetellsNothing) {
  for (const double gain : MadeUp(0).gains()) EXPECT_LT(gain, 3);
}

}  // namespace
}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/blocks.h"

#include <gtest/gtest.h>

#include <array>
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

// A gyro's bias belongs to one recording: the others do not tell it, and it looks there as if the effect were
// less.
TEST(Blocks, ABiasOfOneRecordingIsNoLossOfTheOthers) {
  MadeUp made(1);
  const auto member = parameter_indices(made.library, made.effects).front();
  const Eigen::Index rows = made.linear.residual.size(), half = rows / 2;
  made.priors.spike.head<Library::kBiases>() = made.priors.slab.head<Library::kBiases>();
  made.linear.design.leftCols<Library::kBiases>().setZero();
  made.linear.design.col(0).head(half) =
      made.linear.design.col(member).head(half) * made.priors.slab[member] / made.priors.slab[0];
  std::mt19937_64 dice(2);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < half; ++i) made.linear.design(i, 0) += normal(dice) / made.priors.slab[0];
  made.linear.residual -= 3 * made.priors.slab[0] * made.linear.design.col(0);
  const std::array<Eigen::Index, 2> recordings{half, rows - half};
  const auto gains = gains_of_recordings(made.effects, {made.linear, made.library, made.priors}, recordings);
  for (const double gain : gains) EXPECT_GT(gain, 100);
}

}  // namespace
}  // namespace navcal::gap

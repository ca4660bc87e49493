// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gap/replay/replay.h"
#include "sim/effects/effect.h"

namespace navcal::gap {

/// One number that a diagnosis may move, with the gyros' biases first: they are nuisances.
struct Unknown {
  std::size_t effect = 0;  ///< index into the library's effects; of a bias: kNuisance
  std::size_t index = 0;   ///< among the effect's parameters, or of the gyro
  std::string_view name;
  double typical = 1;
  double step = 0.2;    ///< of the finite difference about nothing, in typical values
  double onward = 0.2;  ///< the same where the effect is there already
  double least = 0, greatest = 0;
};

/// The effects that could be the cause, and all their parameters in a row. An effect that was excluded keeps its
/// place, so that null banks serve with it and without it, but nothing takes it into account.
class Library {
 public:
  static constexpr std::size_t kNuisance = static_cast<std::size_t>(-1);
  static constexpr Eigen::Index kBiases = 4;

  /// Throws std::invalid_argument for a name that is none.
  explicit Library(std::span<const std::string> excluded);

  [[nodiscard]] std::size_t size() const { return effects_.size(); }
  [[nodiscard]] const sim::EffectDescription& operator[](std::size_t effect) const {
    return effects_[effect]->description();
  }
  /// Whether it may be a cause.
  [[nodiscard]] bool holds(std::size_t effect) const { return held_[effect]; }
  /// Whether it delays something.
  [[nodiscard]] bool is_lag(std::size_t effect) const;
  /// Whether it lets the fins stand anywhere within a width.
  [[nodiscard]] bool is_backlash(std::size_t effect) const;
  /// Whether a linearisation about zero says little of its typical strength.
  [[nodiscard]] bool is_curved(std::size_t effect) const;
  /// Biases, and the unknowns of all effects that may be a cause.
  [[nodiscard]] std::vector<Eigen::Index> moving() const;
  [[nodiscard]] std::span<const Unknown> unknowns() const { return unknowns_; }
  /// Of an effect, among the unknowns.
  [[nodiscard]] Eigen::Index first(std::size_t effect) const { return first_[effect]; }
  [[nodiscard]] Eigen::Index count(std::size_t effect) const {
    return static_cast<Eigen::Index>((*this)[effect].parameters.size());
  }

  /// The nominal model with these values of all unknowns; effects whose values are all zero are not in it, and
  /// values beyond an effect's bounds stand at the bound.
  [[nodiscard]] Model model(const Eigen::VectorXd& values) const;

 private:
  std::vector<std::unique_ptr<sim::Effect>> effects_;
  std::vector<Unknown> unknowns_;
  std::vector<Eigen::Index> first_;
  std::vector<bool> held_;
};

}  // namespace navcal::gap

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

/// One number that a diagnosis estimates. The gyros' biases come first; they are nuisance parameters.
struct Unknown {
  std::size_t effect = 0;  ///< index into the library's effects; kNuisance for a bias
  std::size_t index = 0;   ///< among the effect's parameters, or index of the gyro
  std::string_view name;
  double typical = 1;
  double step = 0.2;    ///< step of the finite difference about zero, in typical values
  double onward = 0.2;  ///< the same where the effect is there already
  double least = 0, greatest = 0;
};

/// The effects that could be the cause, and all their parameters in a row. An excluded effect keeps its place,
/// so that a null bank serves with it and without it, but no step of the inference uses it.
class Library {
 public:
  static constexpr std::size_t kNuisance = static_cast<std::size_t>(-1);
  static constexpr Eigen::Index kBiases = 4;

  /// Throws std::invalid_argument for a name that is no effect.
  explicit Library(std::span<const std::string> excluded);

  [[nodiscard]] std::size_t size() const { return effects_.size(); }
  [[nodiscard]] const sim::EffectDescription& operator[](std::size_t effect) const {
    return effects_[effect]->description();
  }
  /// Whether it may be a cause.
  [[nodiscard]] bool holds(std::size_t effect) const { return held_[effect]; }
  /// Whether it delays something.
  [[nodiscard]] bool is_lag(std::size_t effect) const;
  /// Whether it is a backlash: a dead band of the fins.
  [[nodiscard]] bool is_backlash(std::size_t effect) const;
  /// Whether the effect is so non-linear that a linearisation about zero does not describe its typical
  /// strength.
  [[nodiscard]] bool is_curved(std::size_t effect) const;
  /// Indices of the biases and of the unknowns of all effects that may be a cause.
  [[nodiscard]] std::vector<Eigen::Index> moving() const;
  [[nodiscard]] std::span<const Unknown> unknowns() const { return unknowns_; }
  /// Index of the effect's first parameter among the unknowns.
  [[nodiscard]] Eigen::Index first(std::size_t effect) const { return first_[effect]; }
  [[nodiscard]] Eigen::Index count(std::size_t effect) const {
    return static_cast<Eigen::Index>((*this)[effect].parameters.size());
  }

  /// The nominal model with these values of all unknowns. Effects whose values are all zero are left out;
  /// values beyond an effect's bounds are set to the bound.
  [[nodiscard]] Model model(const Eigen::VectorXd& values) const;

 private:
  std::vector<std::unique_ptr<sim::Effect>> effects_;
  std::vector<Unknown> unknowns_;
  std::vector<Eigen::Index> first_;
  std::vector<bool> held_;
};

}  // namespace navcal::gap

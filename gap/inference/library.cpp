// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/library.h"

#include <algorithm>
#include <array>

#include "gap/thresholds.h"
#include "sim/effects/choice.h"
#include "sim/effects/effect_table.h"

namespace navcal::gap {
namespace {

/// Steps of the finite difference with respect to a parameter, in typical values.
struct Steps {
  double first = 0.2;   ///< about zero
  double onward = 0.2;  ///< where the effect is there already
};

constexpr Steps steps_of(sim::EffectKind kind) {
  switch (kind) {
    case sim::EffectKind::lag:
      // The tangent: a long secant has another shape, and the small lags of a vehicle within tolerance would be
      // taken for another effect. The shape of a lag of typical size comes from linearising again
      // (gap/inference/search.h).
      return {0.1, 0.1};
    case sim::EffectKind::backlash:
      // A backlash shows only where it is wider than the fins' moves, so the step about zero is long. Once a
      // backlash is there, a long step goes past the minimum of the residuals.
      return {0.6, 0.1};
    case sim::EffectKind::amount: break;
  }
  return {};
}

constexpr std::array<std::string_view, 4> kBiasNames{"bias_ax", "bias_az", "bias_by", "bias_bz"};

}  // namespace

Library::Library(std::span<const std::string> excluded) {
  sim::expect_effects(excluded);
  for (std::size_t i = 0; i < kBiasNames.size(); ++i) {
    unknowns_.push_back({kNuisance, i, kBiasNames[i], kTypicalTurnOnBias_rad_s, 1, 1, -1, 1});
  }
  for (const auto& entry : sim::effect_table()) {
    auto effect = entry.make();
    const auto& description = effect->description();
    if (description.place == sim::EffectPlace::lines) continue;
    held_.push_back(std::ranges::find(excluded, entry.name) == excluded.end());
    first_.push_back(static_cast<Eigen::Index>(unknowns_.size()));
    const Steps steps = steps_of(description.kind);
    for (std::size_t i = 0; i < description.parameters.size(); ++i) {
      const auto& parameter = description.parameters[i];
      unknowns_.push_back({effects_.size(), i, parameter.name, parameter.typical, steps.first, steps.onward,
                           parameter.least, parameter.greatest});
    }
    effects_.push_back(std::move(effect));
  }
}

bool Library::is_lag(std::size_t effect) const { return (*this)[effect].kind == sim::EffectKind::lag; }

bool Library::is_backlash(std::size_t effect) const { return (*this)[effect].kind == sim::EffectKind::backlash; }

bool Library::is_curved(std::size_t effect) const { return (*this)[effect].kind != sim::EffectKind::amount; }

std::vector<Eigen::Index> Library::moving() const {
  std::vector<Eigen::Index> columns;
  for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(unknowns_.size()); ++j) {
    const std::size_t effect = unknowns_[static_cast<std::size_t>(j)].effect;
    if (effect == kNuisance || held_[effect]) columns.push_back(j);
  }
  return columns;
}

Model Library::model(const Eigen::VectorXd& values) const {
  Model model;
  for (std::size_t i = 0; i < kBiasNames.size(); ++i) model.bias_rad_s[i] = values[static_cast<Eigen::Index>(i)];
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const auto part = values.segment(first(e), count(e));
    if (part.isZero(0)) continue;
    std::vector<double> parameters;
    for (Eigen::Index i = 0; i < part.size(); ++i) {
      const Unknown& unknown = unknowns_[static_cast<std::size_t>(first(e) + i)];
      parameters.push_back(std::clamp(part[i], unknown.least, unknown.greatest));
    }
    model.effects.add(effects_[e]->clone()).set_parameters(parameters);
  }
  return model;
}

}  // namespace navcal::gap

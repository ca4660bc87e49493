// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "runs/response.h"

/// The causes that the diagnosis of runs knows, each with what it does to the parameters of the response.
///
/// Directions come from physics, and sizes are spread broadly. No number was fitted to runs with a known cause,
/// but the parameters and the heights of the line were chosen with sight of such runs (docs/runs.md).
namespace navcal::runs {

using ParameterVector = Eigen::Matrix<double, kParameterCount, 1>;

/// What one size of a cause predicts: the parameters move by `shift`, give or take `spread` (standard deviations).
struct Prediction {
  ParameterVector shift = ParameterVector::Zero();
  ParameterVector spread = ParameterVector::Zero();
  /// A line of this height, dB, stands in the spectrum of the yaw rate, at a frequency that is not known.
  std::optional<double> line_dB;
  /// Probability that the line shows: the shaft's rate may be folded onto one at which it does not.
  double line_shows = 1;
};

struct EffectInformation {
  std::string_view name;   ///< as the label of the runs of Ji (2021), which outsiders use
  std::string_view words;  ///< another name, which `--removed` takes too
  /// Effects of one family differ in size, not in kind.
  std::string_view family;
};
inline constexpr std::array<EffectInformation, 4> kEffects{{
    {"AddWeight", "weight_added", "weight"},
    {"PressureGain_constant", "depth_sensor_failed", "depth sensor"},
    {"PropellerDamage_slight", "propeller_damaged_slightly", "propeller"},
    {"PropellerDamage_bad", "propeller_damaged_badly", "propeller"},
}};

/// The effect of a name or of its words, in any case of letters; null when there is none.
[[nodiscard]] const EffectInformation* effect_named(std::string_view name);

struct Hypothesis {
  /// Null for the nominal vehicle and for the unknown cause.
  const EffectInformation* effect = nullptr;
  bool unknown = false;
  double prior = 0;
  /// Sizes of equal probability.
  std::vector<Prediction> predictions;
};

/// The nominal vehicle, each effect of the library but the one that is `removed`, and the unknown cause: one
/// physical quantity far off its nominal scatter, in a direction that no effect of the library has. `scatter` is
/// the standard deviation of each parameter over nominal runs.
[[nodiscard]] std::vector<Hypothesis> hypotheses(const ParameterVector& scatter, const EffectInformation* removed);

}  // namespace navcal::runs

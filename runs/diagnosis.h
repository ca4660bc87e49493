// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runs/effects.h"
#include "runs/nominal_vehicle.h"

namespace navcal::runs {

enum class Verdict {
  nominal,    ///< the vehicle is as the nominal runs show it
  explained,  ///< an effect of the library, or one of a family of which the size is not told
  unknown,    ///< off the nominal, and no effect of the library does that
  undecided,  ///< the runs do not tell
};
/// "no-gap", "explained", "unknown", "undecided".
[[nodiscard]] std::string_view verdict_name(Verdict verdict);

struct Candidate {
  std::string name;  ///< of the effect, or "no-gap", or "unknown"
  double probability = 0;
};

struct RunDiagnosis {
  Verdict verdict = Verdict::undecided;
  /// On which the verdict rests, most probable first; empty unless explained.
  std::vector<Candidate> effects;
  /// All hypotheses, most probable first.
  std::vector<Candidate> candidates;
  /// Parameters less the nominal, and the standard deviation of that for a nominal vehicle; NaN where not shown.
  ParameterVector deviations, standard_deviations;
  /// Runs that were used, of those given: those whose thrusters ran.
  std::size_t runs_used = 0;
};

/// Diagnoses runs of one session together; one run alone is a session of one.
[[nodiscard]] RunDiagnosis diagnose(const NominalVehicle& vehicle, std::span<const Response> responses,
                                    const EffectInformation* removed);

}  // namespace navcal::runs

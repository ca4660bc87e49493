// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gap/inference/library.h"
#include "gap/verdict/diagnosis.h"
#include "gap/verdict/find_effects.h"
#include "gap/verdict/holdout.h"
#include "sim/effects/description.h"

namespace navcal::gap {

/// Manoeuvres that separate two effects, as text.
[[nodiscard]] std::string tie_breaker(const sim::EffectDescription& one, const sim::EffectDescription& other);

/// Writes the effects of the verdict, or the candidates where there is none, and the effects that each may be
/// confused with.
void write_findings(const FoundEffects& result, const Library& library, Diagnosis& answer);

/// Writes how far the gap shrinks, pooled and by channel, and the resulting navigation errors.
void write_gap(const std::vector<Comparison>& compared, const PooledClosure& closure, bool held_out,
               Diagnosis& answer);

/// The set of effects of a fit, with `probability` and `closed`.
[[nodiscard]] Alternative alternative_of(const ModelFit& fit, const Library& library, double probability,
                                         std::optional<double> closed);

/// Whether the recording departs significantly from the nominal vehicle, in its power or in a cell of the residual
/// map. Needs the gap.
[[nodiscard]] bool shows_gap(const Diagnosis& answer);

/// Makes the verdict unknown and writes its sentence, for the reference vehicle and for layouts. An ambiguous gap
/// also gets the manoeuvres that decide between its alternatives. `reason`: what is missing or does not fit.
void write_unknown(UnknownKind kind, std::string_view reason, Diagnosis& answer);

/// Writes the sentence and the next steps, once everything else is known.
void write_words(Diagnosis& answer);

}  // namespace navcal::gap

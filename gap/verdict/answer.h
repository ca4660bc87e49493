// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gap/inference/library.h"
#include "gap/verdict/diagnosis.h"
#include "gap/verdict/find_effects.h"
#include "gap/verdict/holdout.h"

namespace navcal::gap {

/// Writes the effects of the verdict, or the candidates where there is none, and the effects that each may be
/// confused with.
void write_findings(const FoundEffects& result, const Library& library, Diagnosis& answer);

/// Writes how far the gap shrinks, pooled and by channel, and the resulting navigation errors.
void write_gap(const std::vector<Comparison>& compared, const PooledClosure& closure, bool held_out,
               Diagnosis& answer);

/// Writes the sentence and the next steps, once everything else is known.
void write_words(Diagnosis& answer);

}  // namespace navcal::gap

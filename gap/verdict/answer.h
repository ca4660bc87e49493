// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gap/inference/library.h"
#include "gap/verdict/diagnosis.h"
#include "gap/verdict/find_effects.h"
#include "gap/verdict/holdout.h"

namespace navcal::gap {

/// The effects of the verdict, or the candidates where there is none; with what they may be confused with.
void write_findings(const FoundEffects& result, const Library& library, Diagnosis& answer);

/// How far the gap shrinks, pooled and by channel, and what that means for whoever navigates.
void write_gap(const std::vector<Comparison>& compared, const PooledClosure& closure, bool held_out,
               Diagnosis& answer);

/// Sentence and what to do next, once everything else stands.
void write_words(Diagnosis& answer);

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "gap/verdict/find_effects.h"
#include "gap/verdict/request.h"

namespace navcal::gap {

/// Gets the prepared recordings and what was found in them, once the answer is complete. They are valid during the
/// call.
using Afterwards =
    std::function<void(const DiagnosisProblem& problem, const FoundEffects& found, const Diagnosis& answer)>;

/// The same as diagnose(), for who needs more than the answer. `afterwards` is not called where the recordings
/// cannot be diagnosed.
[[nodiscard]] Diagnosis diagnose_further(const Request& request, const Progress& progress,
                                         const Afterwards& afterwards);

}  // namespace navcal::gap

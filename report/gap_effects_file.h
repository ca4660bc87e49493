// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gap/verdict/diagnosis.h"

namespace navcal::report {

/// The effects found, in the format of `navcal simulate --effects` (docs/simulator.md), with standard errors
/// beside the values. A value outside the simulator's range is moved to the bound, with a comment. An
/// effect that the simulator does not have is a comment.
[[nodiscard]] std::string gap_effects_file(const gap::Diagnosis& diagnosis);

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gap/verdict/diagnosis.h"

namespace navcal::report {

/// The effects that were found as `navcal simulate --effects` takes them (docs/simulator.md), with standard errors
/// beside the values. What the simulator would refuse is brought within its range, and said.
[[nodiscard]] std::string gap_effects_file(const gap::Diagnosis& diagnosis);

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gap/verdict/diagnosis.h"

namespace navcal::report {

/// The answer of `navcal gap --json` (docs/gap.md): one object, no newline. Values that are not finite are null.
[[nodiscard]] std::string gap_json(const gap::Diagnosis& diagnosis);

}  // namespace navcal::report

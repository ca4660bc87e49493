// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "runs/diagnosis.h"

namespace navcal::report {

/// One JSON object on one line, with a line feed: what was found in a run or in a pool of runs (docs/runs.md).
/// `kind` is "run" or "pool".
[[nodiscard]] std::string run_diagnosis_json(std::string_view kind, std::string_view name,
                                             const runs::RunDiagnosis& diagnosis);

}  // namespace navcal::report

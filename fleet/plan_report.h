// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "fleet/plan.h"
#include "fleet/result_store.h"

namespace navcal::fleet {

/// One line for each task: number, state, job, null bank, recording. Errors of failed tasks stand below them.
[[nodiscard]] std::string list_text(const Plan& plan, const ResultStore& results);

/// The same as one JSON object a line, with the full hashes.
[[nodiscard]] std::string list_json(const Plan& plan, const ResultStore& results);

/// The results of a plan as a page: counts, verdicts, effects, a row for each recording, errors.
[[nodiscard]] std::string merge_page(const Plan& plan, const ResultStore& results);

}  // namespace navcal::fleet

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "fleet/plan.h"
#include "fleet/result_store.h"

namespace navcal::fleet {

/// The results of a plan as a page: counts, verdicts, effects, a row for each recording, errors.
[[nodiscard]] std::string merge_page(const Plan& plan, const ResultStore& results);

}  // namespace navcal::fleet

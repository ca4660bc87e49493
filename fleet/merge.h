// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

#include "fleet/plan.h"

namespace navcal::fleet {

struct MergeSummary {
  std::size_t done = 0, failed = 0, open = 0;
};

/// Writes all results of a plan into one SQLite file; docs/fleet.md has its tables. The same plan and results give
/// the same bytes, in whatever order and wherever the tasks were done. Throws analysis::Failure,
/// std::system_error.
[[nodiscard]] MergeSummary merge(const Plan& plan, const std::filesystem::path& file);

}  // namespace navcal::fleet

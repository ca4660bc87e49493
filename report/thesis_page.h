// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "analysis/thesis/thesis_results.h"

namespace navcal::report {

/// The page of `navcal thesis`: findings, an index, every table and figure, and the errata of the thesis.
[[nodiscard]] std::string thesis_page(const analysis::ThesisResults& results);

/// One JSON object in a line with the same tables and figures (docs/thesis.md describes the keys).
[[nodiscard]] std::string thesis_json(const analysis::ThesisResults& results);

}  // namespace navcal::report

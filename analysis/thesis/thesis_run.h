// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

#include "analysis/thesis/thesis_results.h"

namespace navcal::analysis {

struct ThesisRequest {
  std::filesystem::path folder;  ///< of the paths
  int runs = 400;                ///< with noise, of each path and method
  std::uint64_t seed = 1;
};

/// What is being computed, and the share of the whole that is done.
using ThesisProgress = std::function<void(std::string_view what, double done)>;

/// Computes everything that the tables and figures of the thesis show. The same request gives the same results.
/// Throws as load_thesis_paths().
[[nodiscard]] ThesisResults thesis_results(const ThesisRequest& request, const ThesisProgress& progress);

}  // namespace navcal::analysis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/surfacing_run.h"

namespace navcal::report {

/// Statistics over the surfacings; seconds. Nullopt where no surfacing has the value.
struct SurfacingStatistics {
  std::size_t count = 0;
  std::size_t with_ttff = 0;  ///< whose time of surfacing is known
  std::optional<double> ttff_least_s, ttff_median_s, ttff_mean_s, ttff_p90_s, ttff_longest_s;
  std::size_t with_error = 0;
  /// Root of the mean square of error over stated standard error: about 1 when the statement is right, below 1
  /// when the true errors are smaller.
  std::optional<double> error_over_std;
};

[[nodiscard]] SurfacingStatistics statistics_of(const std::vector<analysis::RecordedSurfacing>& surfacings);

/// A table for people.
[[nodiscard]] std::string surfacings_text(const std::vector<analysis::RecordedSurfacing>& surfacings);
/// One JSON object (docs/surfacing.md), with a line feed.
[[nodiscard]] std::string surfacings_json(const std::vector<analysis::RecordedSurfacing>& surfacings,
                                          const std::vector<std::string>& files);
/// One row of the table for each surfacing, after its heads.
[[nodiscard]] std::vector<std::string> surfacing_heads();
[[nodiscard]] std::vector<std::string> surfacing_row(const analysis::RecordedSurfacing& surfacing);
/// The statistics as sentences.
[[nodiscard]] std::vector<std::string> surfacing_sentences(const SurfacingStatistics& statistics);

/// A page with the distribution of the time to first fix, that time against the time under water with the model of
/// the receiver, the error of the dead reckoning against the time without fixes, and a table.
[[nodiscard]] std::string surfacings_page(const std::vector<analysis::RecordedSurfacing>& surfacings,
                                          const std::vector<std::string>& files, const config::Settings& settings);

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "gap/verdict/diagnosis.h"
#include "report/gap_words.h"
#include "report/html_page.h"

namespace navcal::report {

/// Channels by covariates; each cell is the gap as a multiple of the floor. nullopt without a map.
[[nodiscard]] std::optional<Figure> map_figure(const gap::Diagnosis& diagnosis);
/// Effects by probability, those of the verdict first; nullopt if none was considered.
[[nodiscard]] std::optional<Figure> cause_figure(const gap::Diagnosis& diagnosis);
/// Share of the gap that closes, in total and by channel; nullopt if no effect closes it.
[[nodiscard]] std::optional<Figure> closure_figure(const gap::Diagnosis& diagnosis, const GapSource& source);

/// The fixes, and the track of the model before and after; nullopt without a fix.
[[nodiscard]] std::optional<Figure> track_figure(const gap::Diagnosis& diagnosis);
/// Residuals of the strongest channel against its covariates.
[[nodiscard]] std::optional<Figure> scatter_figure(const gap::Diagnosis& diagnosis);
/// Residuals over time, of the channels with a gap and of the others.
struct CourseFigures {
  std::vector<Figure> of_the_gap, others;
};
[[nodiscard]] CourseFigures course_figures(const gap::Diagnosis& diagnosis);

}  // namespace navcal::report

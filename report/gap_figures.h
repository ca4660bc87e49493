// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "gap/verdict/diagnosis.h"
#include "report/gap_words.h"
#include "report/html_page.h"

namespace navcal::report {

/// Channels by regimes, each cell as many times the floor as its gap is; nullopt without a map.
[[nodiscard]] std::optional<Figure> map_figure(const gap::Diagnosis& diagnosis);
/// Effects by probability, those on which the verdict rests first; nullopt when none was considered.
[[nodiscard]] std::optional<Figure> cause_figure(const gap::Diagnosis& diagnosis);
/// How much of the gap closes, altogether and by channel; nullopt when there is nothing to close it with.
[[nodiscard]] std::optional<Figure> closure_figure(const gap::Diagnosis& diagnosis, const GapSource& source);

/// The fixes, and the track of the model before and after; nullopt without a fix.
[[nodiscard]] std::optional<Figure> track_figure(const gap::Diagnosis& diagnosis);
/// Residuals of the strongest channel against what drives them.
[[nodiscard]] std::optional<Figure> scatter_figure(const gap::Diagnosis& diagnosis);
/// Residuals over time, of the channels where the gap lies and of the others.
struct CourseFigures {
  std::vector<Figure> of_the_gap, others;
};
[[nodiscard]] CourseFigures course_figures(const gap::Diagnosis& diagnosis);

}  // namespace navcal::report

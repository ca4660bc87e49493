// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "runs/response.h"

namespace navcal::runs {

/// Groups runs into sessions: one day, one ballast, one battery after the other.
///
/// The clock of a run has no date, so days overlap on it. A run joins the session whose latest runs it follows
/// within half an hour and resembles in attitude at rest and in pressure at the surface; else it begins a new one.
/// Neither commands nor what happens under thrust takes part. Returns the places of the runs, a list a session.
[[nodiscard]] std::vector<std::vector<std::size_t>> sessions_of(std::span<const RestState> rest);

}  // namespace navcal::runs

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/progress.h"
#include "config/settings.h"
#include "identify/data/recorded_motion.h"

namespace navcal::cli {

/// Reads recordings of a vehicle one after the other, and prints the remarks about them. `stated`: the
/// configuration of all, instead of their own. Throws record::BadRecording.
[[nodiscard]] std::vector<identify::RecordedMotion> load_motions(const std::vector<std::string>& files,
                                                                 const std::optional<config::Settings>& stated,
                                                                 analysis::Progress& progress);

}  // namespace navcal::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "config/settings.h"
#include "identify/data/recorded_motion.h"
#include "record/seen_recordings.h"

namespace navcal::cli {

/// Reads recordings of a vehicle one after the other, without those that were `seen` before, and prints the
/// remarks about them. `stated`: the configuration of all, instead of their own; `window`: the part of each that
/// is used. Throws record::BadRecording.
[[nodiscard]] std::vector<identify::RecordedMotion> load_motions(const std::vector<std::string>& files,
                                                                 const std::optional<config::Settings>& stated,
                                                                 base::Progress& progress,
                                                                 record::SeenRecordings& seen,
                                                                 const record::TimeWindow& window = {});

}  // namespace navcal::cli

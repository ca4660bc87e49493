// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "config/settings.h"
#include "gap/watch/watch.h"

namespace navcal::gap {

/// Hands a capture or a log to a watch as if it came now. `settings`: as for load_mission(). `go_on` is called
/// with the share that is done; false ends it. Throws record::BadRecording.
void watch_recording(const std::filesystem::path& file, const std::optional<config::Settings>& settings,
                     Watch& watch, const std::function<bool(double)>& go_on);

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "record/log/log_info.h"

namespace navcal::analysis {

/// A log, as navcald would have written it of these bytes: raw bytes, and the samples, estimates and calibrations
/// that the pipeline makes of them, with the usual settings of each protocol. The file appears under its name only
/// when it is whole. Returns what is to be told to the user. Throws record::BadRecording, also when it is a log
/// already; std::system_error; what `progress` throws ends it too.
std::vector<std::string> import_capture(const std::filesystem::path& capture, const std::filesystem::path& log,
                                        const record::Progress& progress);

}  // namespace navcal::analysis

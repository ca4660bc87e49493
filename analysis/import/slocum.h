// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "analysis/import/import_sink.h"

namespace navcal::analysis {

[[nodiscard]] bool is_slocum(std::string_view head);

/// Data of a Slocum glider (.dbd, .sbd, .tbd, .ebd; compressed .dcd, ...), encoding 5: ASCII header, list of
/// sensors, cycles in which each sensor is new, repeated or absent. Taken are the new values. A list that is a
/// file of its own is looked for in `folders`; throws record::BadRecording, which names it, where none has it.
/// docs/import.md has the table of sensors.
[[nodiscard]] ImportFindings read_slocum(std::string_view file, std::span<const std::filesystem::path> folders,
                                         ImportSink& sink);

}  // namespace navcal::analysis

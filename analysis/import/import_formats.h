// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "analysis/import/import_sink.h"

namespace navcal::analysis {

struct ImportOptions {
  std::string format;  ///< name of a format; empty: the content says it
  std::string
      map;  ///< file that gives columns of a CSV file, or channels of another log, their meaning; empty: none
  std::vector<std::filesystem::path> folders{};  ///< where a Slocum's lists of sensors are
  bool keeps_calibration = false;  ///< fields of a telemetry log stay as the autopilot has corrected them
};

/// A kind of log of another system.
struct ImportFormat {
  std::string_view name;         ///< as --format takes it
  std::string_view description;  ///< for people
  bool (*recognises)(std::string_view head);
  /// Throws record::BadRecording for what cannot be read at all.
  ImportFindings (*read)(std::string_view file, const ImportOptions& options, ImportSink& sink);
};

/// The format of a file for which a map is given.
inline constexpr std::string_view kCsvFormat = "csv";

/// Names of all formats, for people.
[[nodiscard]] std::string import_format_names();

/// nullptr when no format recognises these first bytes of a file.
[[nodiscard]] const ImportFormat* import_format_of(std::string_view head);
/// nullptr when there is no format of this name.
[[nodiscard]] const ImportFormat* import_format_named(std::string_view name);

}  // namespace navcal::analysis

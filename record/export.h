#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "record/log_info.h"

namespace navcal::record {

struct Exported {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> remarks;
};

/// Raw bytes, sent and received, of a recording as a capture; times to UTC by the mapping in force. The file
/// appears under its name only when it is whole. Throws BadRecording, std::system_error; what `progress` throws
/// ends it too.
Exported export_capture(const std::filesystem::path& recording, const std::filesystem::path& capture,
                        const Progress& progress);

/// A log's topics as one CSV file each, in a folder that is made when it is not there: compass.csv,
/// raw_compass.csv,
/// ...; `time_s` first (UTC), units in the names, absent values empty; the configuration as config.toml. Files
/// appear under their names only when all of them are whole. Throws as above.
Exported export_csv(const std::filesystem::path& log, const std::filesystem::path& folder,
                    const Progress& progress);

}  // namespace navcal::record

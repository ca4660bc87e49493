// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "record/export/topic_table.h"
#include "record/log/log_info.h"

namespace navcal::record {

/// Content of a log except raw bytes, as tables in memory.
struct LogTables {
  std::vector<TopicTable> tables;  ///< in the order of their first messages; none is empty
  std::string configuration;       ///< TOML; empty when the log has none
  std::vector<std::string> remarks;
};

/// Throws BadRecording when it is not a log; what `progress` throws ends it too.
[[nodiscard]] LogTables read_tables(const std::filesystem::path& log, const Progress& progress);

}  // namespace navcal::record

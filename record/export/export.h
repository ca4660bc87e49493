// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "record/log/log_info.h"

namespace navcal::record {

struct Exported {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> remarks;
};

/// Raw bytes, sent and received, of a recording as a capture; times to UTC by the mapping in force. The file
/// appears under its name only when it is whole; "-" is the standard output. Throws BadRecording,
/// std::system_error; what `progress` throws ends it too.
Exported export_capture(const std::filesystem::path& recording, const std::filesystem::path& capture,
                        const Progress& progress);

/// A log's topics as one CSV file each, in a folder that is made when it is not there: compass.csv,
/// raw_compass.csv,
/// ...; `time_s` first (UTC), units in the names, absent values empty; the configuration as config.toml. Files
/// appear under their names only when all of them are whole. Throws as above.
Exported export_csv(const std::filesystem::path& log, const std::filesystem::path& folder,
                    const Progress& progress);

/// A log's topics in one netCDF-4 file by the CF conventions, one group each, columns named as in the CSV files:
/// docs/export.md. The topics are held in memory until they are written. The file appears under its name only
/// when it is whole. Throws as above.
Exported export_netcdf(const std::filesystem::path& log, const std::filesystem::path& file,
                       const Progress& progress);

/// The same as a MAT-file (level 5), one structure of column vectors for each topic. Throws as above; also when a
/// topic is larger than such a file can hold.
Exported export_mat(const std::filesystem::path& log, const std::filesystem::path& file, const Progress& progress);

/// A log's samples, estimates and health as a bag of ROS 2 (docs/export.md); publish_time is the time of validity,
/// log_time that of arrival, both UTC; nothing of before UTC was known. Throws as above.
Exported export_ros2(const std::filesystem::path& log, const std::filesystem::path& bag, const Progress& progress);

/// The same in the axes of navcal.
Exported export_ros2_ned(const std::filesystem::path& log, const std::filesystem::path& bag,
                         const Progress& progress);

}  // namespace navcal::record

// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/import_formats.h"

#include <algorithm>
#include <array>

#include "analysis/import/import_report.h"
#include "analysis/import/log_readers.h"
#include "analysis/import/motor_channels.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

ImportFindings read_glider(std::string_view file, const ImportOptions& options, ImportSink& sink) {
  if (!options.map.empty())
    throw record::BadRecording("this format has no channels that a map (--map) could name");
  return read_slocum(file, options.folders, sink);
}

template <auto Read>
ImportFindings read_with_channels(std::string_view file, const ImportOptions& options, ImportSink& sink) {
  MotorChannels channels;
  if (!options.map.empty()) channels = MotorChannels(config::load_channel_map(options.map));
  constexpr bool kUndoes = requires { Read(file, sink, channels, true); };
  ImportFindings findings = [&] {
    if constexpr (kUndoes)
      return Read(file, sink, channels, !options.keeps_calibration);
    else
      return Read(file, sink, channels);
  }();
  if (findings.has_corrected_fields)
    findings.remarks.push_back(
        std::string(kCorrectedFields) +
        (kUndoes && !options.keeps_calibration ? ": its parameters do not undo that (docs/import.md)" : ""));
  channels.expect_all_found();
  for (std::string& remark : channels.remarks()) findings.remarks.push_back(std::move(remark));
  return findings;
}

ImportFindings read_mapped(std::string_view file, const ImportOptions& options, ImportSink& sink) {
  if (options.map.empty())
    throw record::BadRecording(
        "a CSV file needs a map of its columns: --map FILE.toml. One for the columns t and z:\n\n"
        "  [time]\n  column = \"t\"\n  format = \"unix_s\"\n\n"
        "  [column.z]\n  meaning = \"depth\"\n  unit = \"m\"\n\n"
        "docs/import.md has all meanings and units");
  return read_csv(file, config::load_csv_map(options.map), sink);
}

/// A file of no other format for which a map is given.
bool is_never(std::string_view /*head*/) { return false; }

constexpr std::array kFormats{
    ImportFormat{"dataflash", "ArduPilot DataFlash log (.bin)", is_dataflash, read_with_channels<read_dataflash>},
    ImportFormat{"ulog", "PX4 ULog (.ulg)", is_ulog, read_with_channels<read_ulog>},
    ImportFormat{"ros2", "ROS 2 bag in MCAP (.mcap)", is_ros_bag, read_with_channels<read_ros_bag>},
    ImportFormat{"tlog", "MAVLink telemetry log (.tlog)", is_mavlink_log, read_with_channels<read_mavlink_log>},
    ImportFormat{"slocum", "Slocum glider data (.dbd, .sbd, .dcd, ...)", is_slocum, read_glider},
    ImportFormat{kCsvFormat, "CSV file with a map of its columns", is_never, read_mapped},
};

}  // namespace

std::string import_format_names() {
  std::string names;
  for (const ImportFormat& format : kFormats) names.append(names.empty() ? "" : ", ").append(format.name);
  return names;
}

const ImportFormat* import_format_of(std::string_view head) {
  const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                  [&](const ImportFormat& format) { return format.recognises(head); });
  return found == kFormats.end() ? nullptr : &*found;
}

const ImportFormat* import_format_named(std::string_view name) {
  const auto found = std::ranges::find(kFormats, name, &ImportFormat::name);
  return found == kFormats.end() ? nullptr : &*found;
}

}  // namespace navcal::analysis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "analysis/import/import_sink.h"
#include "analysis/import/motor_channels.h"
#include "config/csv_map.h"

// Logs of other systems; docs/import.md has the table of each. `channels` become shaft and fins.
// `undoes_calibration`: takes the autopilot's own calibration off the fields, where the log tells it.
namespace navcal::analysis {

/// A CSV file whose columns have their meaning by `map`. Vectors count only when all three components are there. A
/// cell that is empty, or that is no number, is absent. Throws record::BadRecording when the header line lacks a
/// column of the map.
[[nodiscard]] ImportFindings read_csv(std::string_view file, const config::CsvMap& map, ImportSink& sink);

/// Whether a file begins with a FMT record that describes FMT.
[[nodiscard]] bool is_dataflash(std::string_view head);
/// ArduPilot's DataFlash log (.bin), version of the self-describing records A3 95. Taken are IMU, MAG, BARO, GPS
/// (with the errors of GPA), ATT (with the error of the heading by XKV1), BAT and RCOU; columns, units and
/// multipliers by FMT, FMTU, UNIT and MULT. ArduPilot's body axes are those of navcal: forward, starboard, down.
/// Its calibration: the offsets and motor field that each MAG states, and the COMPASS_ parameters of the log.
[[nodiscard]] ImportFindings read_dataflash(std::string_view file, ImportSink& sink, MotorChannels& channels,
                                            bool undoes_calibration = true);

[[nodiscard]] bool is_ulog(std::string_view head);
/// PX4's ULog (.ulg), by the definitions of its own messages. Times are microseconds since boot; UTC follows from
/// the receiver. PX4's body axes are those of navcal: forward, starboard, down. Its calibration: that of its
/// compasses, by its parameters.
[[nodiscard]] ImportFindings read_ulog(std::string_view file, ImportSink& sink, MotorChannels& channels,
                                       bool undoes_calibration = true);

/// Whether a file begins with a time of this century and an intact MAVLink frame.
[[nodiscard]] bool is_mavlink_log(std::string_view head);
/// MAVLink telemetry log (.tlog): frames of version 1 or 2, each behind the UTC of the computer that received it,
/// eight bytes, big endian, in microseconds. instruments::MavlinkDecoder reads them, as it does live. Its
/// calibration: the autopilot's parameters.
[[nodiscard]] ImportFindings read_mavlink_log(std::string_view file, ImportSink& sink, MotorChannels& channels,
                                              bool undoes_calibration = true);

/// Whether a file is an MCAP file that navcal has not written.
[[nodiscard]] bool is_ros_bag(std::string_view head);
/// ROS 2 bag in an MCAP file, messages in CDR. Axes of REP-103 (forward, left, up; east, north, up) become those
/// of navcal (forward, starboard, down; north, east, down). The stamp of a message's header is its time of
/// validity where it lies within an hour of the time at which it was logged. Chunks may be compressed with lz4 or
/// zstd.
[[nodiscard]] ImportFindings read_ros_bag(std::string_view file, ImportSink& sink, MotorChannels& channels);

[[nodiscard]] bool is_slocum(std::string_view head);
/// Data of a Slocum glider (.dbd, .sbd, .tbd, .ebd; compressed .dcd, ...), encoding 5: ASCII header, list of
/// sensors, cycles in which each sensor is new, repeated or absent. Taken are the new values. A list that is a
/// file of its own is looked for in `folders`; throws record::BadRecording, which names it, where none has it.
[[nodiscard]] ImportFindings read_slocum(std::string_view file, std::span<const std::filesystem::path> folders,
                                         ImportSink& sink);

}  // namespace navcal::analysis

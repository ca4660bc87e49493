// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "analysis/import/import_formats.h"
#include "analysis/import/import_report.h"
#include "protocols/frame.h"
#include "record/log/log_info.h"

namespace navcal::analysis {

/// Makes a log of a file of another system: each source instrument is a port of the protocol `samples`, the bytes
/// are lines of injected samples. The file is read twice: first for its instruments, its times and its UTC, then
/// for the samples. What other systems keep in memory order is put in the order of time.
///
/// UTC is the clock of the file where its times are UTC. Else it follows from the times that a receiver with a fix
/// states; the largest difference to the clock of the file counts, since it belongs to the fix that was logged
/// with the least delay. Else times count from 2000-01-01, and the report says so.
///
/// The log appears under its name only when it is whole. Throws record::BadRecording for what cannot be read,
/// std::system_error; what `progress` throws ends it too.
[[nodiscard]] ImportReport import_log(const std::filesystem::path& input, const std::filesystem::path& log,
                                      const ImportOptions& options, const record::Progress& progress);

/// A log without UTC begins its times here: 2000-01-01.
inline constexpr std::int64_t kStatedDate_ns = 946'684'800'000'000'000;

/// UTC of a receiver is logged some tenths of a second late. The fix with the least delay counts, and this is how
/// uncertain that one is.
inline constexpr std::int64_t kGpsBound_ns = 300'000'000;

/// Makes a log of the bytes of one device, as somebody has saved them (`cat /dev/ttyUSB0 > FILE`). The bytes of
/// each time that a receiver states, with a fix, begin at that time and follow one another at the speed of the
/// line; 0: as the device is delivered. Without such times they do so from 2000-01-01 on, and the report says it.
[[nodiscard]] ImportReport import_bytes(const std::filesystem::path& input, protocols::Protocol protocol, int baud,
                                        const std::filesystem::path& log, const record::Progress& progress);
/// The device whose bytes a file has by its name or its first bytes: NMEA 0183 or UBX.
[[nodiscard]] std::optional<protocols::Protocol> device_of(const std::filesystem::path& input);

/// Whether the file is one of the known formats, by name or content. Throws as import_log() does.
[[nodiscard]] bool is_foreign_log(const std::filesystem::path& input, const ImportOptions& options);

}  // namespace navcal::analysis

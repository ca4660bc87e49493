// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calib/suite/report.h"
#include "pipeline/calibration.h"
#include "pipeline/utc_mapping.h"

namespace navcal::record {

/// CALIB of the status socket and of /calib (docs/status-protocol.md): one object a line, no newlines; several
/// when one would be longer than gpsd's clients can read. Angles in degrees. `compasses`: what is known of
/// the calibrations that compasses make of themselves, members "tcm2" or "pni"; empty for none.
[[nodiscard]] std::vector<std::string> calib_lines(const calib::Report& report, std::optional<std::int64_t> utc_ns,
                                                   std::string_view compasses = {});

/// The answer of `navcal calibrate`: one object with `gyro`, `gyro_b`, `compass`, `magnetometer` and `heading`,
/// and beyond them `misalignment`, `gps_compass`, `swing`, `latency`, `left_out`. No newline.
void append_calibrate_json(std::string& out, const calib::Report& report);

/// CALIBRATION of /calib: a change, from which replay goes on.
void append_json(std::string& out, const pipeline::UtcMapping& mapping, const pipeline::CalibrationChange& change);

/// Told from CALIB without reading it whole.
[[nodiscard]] bool is_calibration_change(std::string_view json);
/// The members that replay needs: time, cause, calibrator and state; nullopt if the object is of another kind.
[[nodiscard]] std::optional<pipeline::CalibrationChange> calibration_from_json(std::string_view json);

}  // namespace navcal::record

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "instruments/samples.h"

namespace navcal::record {

/// "7-1a2b3c4d"; the number must not be 0.
[[nodiscard]] std::string calibration_text(instruments::CalibrationName name);

/// Appends one JSON object (no newline) with the keys of docs/cli.md's `replay`: class, time, time_std, arrival,
/// device, then SI values; absent optionals are null. Live log and replay share it, so they agree to the byte.
void append_json(std::string& out, const instruments::Sample& sample, std::string_view device);

}  // namespace navcal::record

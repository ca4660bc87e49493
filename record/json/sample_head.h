// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "instruments/samples.h"
#include "record/json/json_object.h"

namespace navcal::record {

// The members that samples of instruments and what is estimated of them have in common.

void append_head(JsonObject& json, const instruments::Stamp& stamp, std::string_view device);
/// null when none is in force.
void append_calibration(JsonObject& json, instruments::CalibrationName name);

}  // namespace navcal::record

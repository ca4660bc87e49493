// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "calib/suite/report.h"
#include "config/settings.h"
#include "gap/data/earth_field.h"
#include "record/recording.h"

namespace navcal::gap {

/// Compares the instruments of a recording with each other where one is missing that the diagnosis needs
/// (docs/calibration.md). It estimates iron about the compass from its own field, deviation from the gyro or
/// from course over ground, scale and bias of the gyro, and delays. `stated` is the configuration to use
/// instead of the recording's own. `field` gives the declination, where it is known. `progress` gets 0 to 1.
/// Throws record::BadRecording.
[[nodiscard]] calib::Report instruments_alone(const std::filesystem::path& file,
                                              const std::optional<config::Settings>& stated,
                                              const EarthField& field, const std::function<void(double)>& progress,
                                              const record::TimeWindow& window = {});

}  // namespace navcal::gap

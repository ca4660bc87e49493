// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "calib/suite/report.h"
#include "config/settings.h"
#include "gap/data/earth_field.h"

namespace navcal::gap {

/// What the instruments of a recording show of each other where one is missing that the diagnosis needs: iron
/// about the compass by its own field, its deviation by the gyro or by the way over ground, the gyro's scale and
/// bias, delays (docs/calibration.md). `stated` is the configuration to use instead of the
/// recording's own. `field` gives the declination, where it is known. `progress`
/// gets 0 to 1. Throws record::BadRecording.
[[nodiscard]] calib::Report instruments_alone(const std::filesystem::path& file,
                                              const std::optional<config::Settings>& stated,
                                              const EarthField& field,
                                              const std::function<void(double)>& progress);

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "calib/suite/report.h"
#include "gap/data/earth_field.h"

namespace navcal::gap {

/// What the instruments of a recording show of each other where one is missing that the diagnosis needs: iron
/// about the compass by its own field, its deviation by the gyro or by the way over ground, the gyro's scale and
/// bias, delays (docs/calibration.md). `field` gives the declination, where it is known. `progress`
/// gets 0 to 1. Throws record::BadRecording.
[[nodiscard]] calib::Report instruments_alone(const std::filesystem::path& file, const EarthField& field,
                                              const std::function<void(double)>& progress);

}  // namespace navcal::gap

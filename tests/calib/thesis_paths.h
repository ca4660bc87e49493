// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "calib/thesis/measured_path.h"

/// The reference paths of fixtures/paths/.
namespace navcal::calib::test {

using thesis::compass_of, thesis::Deviation, thesis::deviation_rad, thesis::kNoNoise, thesis::kTrueBias_rad_s;
using thesis::kTrueScale, thesis::measure, thesis::Measured, thesis::measured_heading_rad, thesis::Noise;
using thesis::Random, thesis::rate_of, thesis::thesis_deviation, thesis::TruePoint;

/// `name`: "path1" ... "path8" (501 rows, 10 Hz), "path_long600" (600 s).
[[nodiscard]] std::vector<TruePoint> load_true_path(const std::string& name);

}  // namespace navcal::calib::test

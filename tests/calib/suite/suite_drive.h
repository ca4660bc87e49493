// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "calib/suite/suite.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::calib::test {

/// Correction of gyro B: true = 1.05 measured - 0.02.
inline constexpr RateCorrection kGyroB{1.05, -0.02};

/// Readings of compass and gyros of the thesis's vehicle along a path, in order of time; the motor runs.
inline std::vector<Reading> readings_along(const std::string& path, const Deviation& deviation, const Noise& noise,
                                           std::uint64_t seed) {
  Random random(seed);
  std::normal_distribution<double> normal;
  const auto points = load_true_path(path);
  const auto measured = measure(points, deviation, noise, random);
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Measured& m = measured[i];
    RateReading rate = rate_of(m);
    rate.yaw_rate_b_rad_s =
        (points[i].rate_rad_s.z() - kGyroB.bias_rad_s) / kGyroB.scale + noise.rate_rad_s * normal(random);
    readings.emplace_back(rate);
    readings.emplace_back(compass_of(m));
  }
  return readings;
}

/// Options for the thesis's vehicle: its noise, a constant bias, an inclinometer without lag.
inline SuiteOptions thesis_options() {
  SuiteOptions options;
  options.heading_noise_rad = 0.004;
  options.rate_noise_rad_sqrt_s = 0.0016;
  options.bias_walk_rad_s_sqrt_s = 0;
  options.tilt_lag_s = 0;
  return options;
}
inline constexpr Instruments kCompassAndGyros{true, true, false, false};
inline constexpr Instruments kEveryInstrument{true, true, true, true, true};

inline std::string saved(Suite& suite) {
  Archive archive;
  suite.archive(archive);
  return archive.bytes();
}

/// Another suite that was given a saved state.
inline Suite restored(const std::string& state, const SuiteOptions& options, const Instruments& instruments) {
  Suite suite(options, instruments);
  Archive archive{std::string_view(state)};
  suite.archive(archive);
  EXPECT_TRUE(archive.ok() && archive.at_end());
  return suite;
}

}  // namespace navcal::calib::test

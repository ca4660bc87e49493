// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/path.h"
#include "sim/state.h"

// A capture of the emulated instruments carried along a path, as fast as it can be made.
namespace navcal::cli::test {

struct RecordingOptions {
  double duration_s = 60;
  bool compass = true, imu = true, gps = true, motor = true;
  /// Iron about the compass: field read = matrix * field + offset.
  Eigen::Vector3d offset_uT = Eigen::Vector3d::Zero();
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  double gyro_scale = 1;  ///< of A-z: read over true
  std::uint64_t seed = 1;
  std::int64_t begin_s = 1'900'000'000;  ///< UTC
};

/// Straight legs, circles to both sides and turns at the surface, `duration_s` long.
[[nodiscard]] std::vector<sim::PathRow> turning_path(double duration_s);
/// Always straight ahead.
[[nodiscard]] std::vector<sim::PathRow> straight_path(double duration_s);

/// Text of a capture with the ports compass, imu, gps, motor.
[[nodiscard]] std::string simulated_recording(const std::vector<sim::PathRow>& path,
                                              const RecordingOptions& options);

}  // namespace navcal::cli::test

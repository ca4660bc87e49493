// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "analysis/thesis/thesis_results.h"
#include "calib/thesis/distorted_field.h"

/// The parts of thesis_results().
namespace navcal::analysis {

[[nodiscard]] ThesisGyro thesis_gyro_result(const ThesisPath& path, int runs, std::uint64_t seed);
[[nodiscard]] ThesisCompass thesis_compass_result(const ThesisPath& path, std::size_t row, int runs,
                                                  std::uint64_t seed);
/// `row` of table 4.2.
[[nodiscard]] ThesisCircle thesis_circle_result(std::size_t row, int runs, std::uint64_t seed);
[[nodiscard]] ThesisFieldPath thesis_field_path(const ThesisPath& path, const calib::EllipseShape& field, int runs,
                                                std::uint64_t seed);

[[nodiscard]] ThesisTurnTrace thesis_turn_trace(const ThesisPath& path, int number, bool noisy,
                                                std::uint64_t seed);
[[nodiscard]] ThesisCompassTrace thesis_compass_trace(const ThesisPath& path, int number, bool noisy,
                                                      std::uint64_t seed);
[[nodiscard]] ThesisCircleTrace thesis_circle_trace(std::size_t row, std::uint64_t seed);

[[nodiscard]] ThesisFirstFixes thesis_first_fixes(int under_s, int longest_s, std::uint64_t seed);

/// Time from which on both estimates stay within kSettled of the true values.
inline constexpr double kThesisSettled = 0.05;
[[nodiscard]] std::optional<double> thesis_settled_s(const std::vector<double>& time_s,
                                                     const std::vector<double>& scale,
                                                     const std::vector<double>& bias_rad_s);

}  // namespace navcal::analysis

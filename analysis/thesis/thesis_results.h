// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/thesis/thesis_paths.h"
#include "calib/thesis/algorithm_runs.h"
#include "calib/thesis/turn_problem.h"

/// Tables and figures of the thesis, recomputed. Vectors of two are (abar, bbar in rad/s), of four (B, C, D, E in
/// radians). "Noise" is that of the thesis (calib::thesis::Noise), rms is over the runs.
namespace navcal::analysis {

/// A path's rows of tables 3.1 and 3.2.
struct ThesisGyro {
  Eigen::Vector2d least_squares, adaptive;  ///< algorithms of the thesis, no noise
  Eigen::Vector2d navcal;                   ///< our filter, no noise
  Eigen::Vector2d least_squares_rms, adaptive_rms, navcal_rms;
  Eigen::Vector2d bound;  ///< Cramer-Rao, one standard deviation
  // Times after which both estimates stay close to the true ones; nothing: not within the path.
  std::optional<double> adaptive_settled_s, navcal_settled_s;              ///< without noise
  std::optional<double> adaptive_noisy_settled_s, navcal_noisy_settled_s;  ///< in one run with noise
};

/// A path's row of table 4.1.
struct ThesisCompass {
  Eigen::Vector4d least_squares;                         ///< algorithm and injection of the thesis, no noise
  calib::thesis::HeadingStatistics least_squares_error;  ///< metric of the thesis
  calib::thesis::HeadingStatistics printed_error;        ///< the same metric, of the printed coefficients
  Eigen::Vector4d navcal;                                ///< our filter, self-consistent injection, no noise
  calib::thesis::CurveError navcal_error;
  Eigen::Vector4d least_squares_rms, navcal_rms, bound;         ///< self-consistent injection
  calib::thesis::CurveError least_squares_noisy, navcal_noisy;  ///< means over the runs
};

/// A row of table 4.2: one circle of 629 samples. Degrees.
struct ThesisCircle {
  std::array<double, 2> raw_deg;  ///< least and largest error of the raw heading; medians over the runs with noise
  double residual_deg;            ///< largest residual of a sample, method of the thesis; median with noise
  double thesis_deg, navcal_deg;  ///< largest error of the calibration itself, at headings without noise; the same
  double thesis_rms_deg, navcal_rms_deg, bound_deg;  ///< of the calibration, all round, 0.1 uT noise in every row
};

/// The distortions of figures 4.11 and 4.12 on one of the paths. Largest error of the calibration, degrees.
struct ThesisFieldPath {
  double thesis_deg;                          ///< no noise
  double thesis_noisy_deg, navcal_noisy_deg;  ///< medians over the runs
  double navcal_rms_deg, bound_deg;           ///< all round
};

/// Errors of a gyro calibrated with the estimate at the end of a path, true less estimated.
struct ThesisRateErrors {
  std::vector<double> rate_rad_s;   ///< of the heading rate
  std::vector<double> heading_rad;  ///< of its integral
};

/// Gyro and heading along a path.
struct ThesisTurnTrace {
  int path = 0;
  bool noisy = false;
  std::vector<double> time_s, north_m, east_m, heading_rad, roll_deg;
  std::vector<double> rate_rad_s, measured_rate_rad_s;  ///< true heading rate; gyro
  ThesisRateErrors least_squares, adaptive, navcal;
  std::vector<double> adaptive_state_error_rad;  ///< psi - xhat of the identifier
  // Estimates by the readings so far.
  std::vector<double> adaptive_scale, adaptive_bias_rad_s, navcal_scale, navcal_bias_rad_s;
};

/// Compass along a path, and its deviation over the circle; degrees.
struct ThesisCompassTrace {
  int path = 0;
  bool noisy = false;
  std::vector<double> time_s, north_m, east_m, heading_deg, measured_deg;
  std::vector<double> circle_deg;                            ///< headings 0 to 360
  std::vector<double> injected_deg, thesis_deg, navcal_deg;  ///< deviation
  std::vector<double> thesis_error_deg, perfect_error_deg;   ///< metric of the thesis; of the true coefficients
  std::vector<double> navcal_error_deg;                      ///< self-consistent metric
};

/// A row of table 4.2 drawn.
struct ThesisCircleTrace {
  std::vector<double> heading_deg;               ///< of the samples
  std::vector<double> raw_x_uT, raw_y_uT;        ///< forward, starboard
  std::vector<double> thesis_x_uT, thesis_y_uT;  ///< calibrated by the method of the thesis
  std::vector<double> raw_error_deg, thesis_error_deg, navcal_error_deg;
};

/// Surfacings of the simulated receiver (figures 1.1, 1.2), whose search takes any time up to the longest.
struct ThesisFirstFixes {
  int under_s = 0, longest_s = 0;  ///< time under water; longest search
  std::vector<int> times_s;        ///< from each surfacing to its first fix
};

struct ThesisResults {
  int runs = 0;
  std::uint64_t seed = 0;
  std::array<ThesisGyro, kThesisPaths> gyro;
  std::array<ThesisCompass, kThesisPaths> compass;
  calib::thesis::HeadingStatistics perfect_error;  ///< metric of table 4.1, of the true coefficients
  std::array<ThesisCircle, 5> circles;
  std::array<std::array<ThesisFieldPath, kThesisPaths>, 2> field_paths;  ///< figures 4.11, 4.12
  std::vector<ThesisTurnTrace> turn_traces;
  std::vector<ThesisCompassTrace> compass_traces;
  std::array<ThesisCircleTrace, 5> circle_traces;
  std::array<ThesisFirstFixes, 2> first_fixes;
};

struct ThesisRequest {
  std::filesystem::path folder;  ///< of the paths
  int runs = 400;                ///< with noise, of each path and method
  std::uint64_t seed = 1;
};

/// What is being computed, and the share of the whole that is done.
using ThesisProgress = std::function<void(std::string_view what, double done)>;

/// Computes everything that the tables and figures of the thesis show. The same request gives the same results.
/// Throws as load_thesis_paths().
[[nodiscard]] ThesisResults thesis_results(const ThesisRequest& request, const ThesisProgress& progress);

}  // namespace navcal::analysis

// SPDX-License-Identifier: Apache-2.0
#include "analysis/thesis/thesis_parts.h"
#include "base/angles.h"
#include "calib/thesis/printed_tables.h"
#include "calib/thesis/turn_problem.h"

namespace navcal::analysis {

namespace thesis = calib::thesis;

ThesisCompass thesis_compass_result(const ThesisPath& path, std::size_t row, int runs, std::uint64_t seed) {
  const Eigen::Vector4d truth = thesis::thesis_deviation().tail<4>();
  ThesisCompass result;
  result.least_squares = thesis::table_4_1_compass(path);
  result.least_squares_error = thesis::table_4_1_statistics(result.least_squares);
  const auto& printed = thesis::kTable4_1.at(row).deviation_deg;
  result.printed_error = thesis::table_4_1_statistics(Eigen::Vector4d(printed.data()) * base::kRadiansPerDegree);
  thesis::Random random(seed);
  const auto clean = thesis::measure(thesis::TurnProblem::compass, path, thesis::kNoNoise, random);
  result.navcal = thesis::filtered(thesis::TurnProblem::compass, clean).estimate().tail<4>();
  result.navcal_error = thesis::curve_error(result.navcal - truth);
  Eigen::Vector4d square = Eigen::Vector4d::Zero();
  for (int run = 0; run < runs; ++run) {
    const Eigen::Vector4d error =
        thesis::thesis_compass(thesis::measure(thesis::TurnProblem::compass, path, thesis::Noise{}, random)) -
        truth;
    square += error.cwiseAbs2() / runs;
    const thesis::CurveError curve = thesis::curve_error(error);
    result.least_squares_noisy.largest_deg += curve.largest_deg / runs;
    result.least_squares_noisy.deviation_deg += curve.deviation_deg / runs;
  }
  result.least_squares_rms = square.cwiseSqrt();
  const thesis::TurnStatistics ours = thesis::monte_carlo(thesis::TurnProblem::compass, path, runs, seed);
  result.navcal_rms = ours.rms;
  result.bound = ours.bound;
  result.navcal_noisy = ours.curve;
  return result;
}

namespace {

double curve_deg(const Eigen::Vector4d& coefficients, double heading_rad) {
  thesis::Deviation whole = thesis::Deviation::Zero();
  whole.tail<4>() = coefficients;
  return thesis::deviation_rad(whole, heading_rad) * base::kDegreesPerRadian;
}

}  // namespace

ThesisCompassTrace thesis_compass_trace(const ThesisPath& path, int number, bool noisy, std::uint64_t seed) {
  constexpr int kStep_deg = 2;
  const Eigen::Vector4d truth = thesis::thesis_deviation().tail<4>();
  const thesis::Noise noise = noisy ? thesis::Noise{} : thesis::kNoNoise;
  thesis::Random random(seed);
  // Without noise the thesis's own injection, as in table 4.1; it is not known how its figure adds the noise.
  const auto readings = thesis::measure(thesis::TurnProblem::compass, path, noise, random);
  const Eigen::Vector4d least_squares = noisy ? thesis::thesis_compass(readings) : thesis::table_4_1_compass(path);
  const Eigen::Vector4d navcal = thesis::filtered(thesis::TurnProblem::compass, readings).estimate().tail<4>();
  ThesisCompassTrace trace;
  trace.path = number;
  trace.noisy = noisy;
  double measured_rad = path.front().heading_rad;
  for (std::size_t k = 0; k < path.size(); ++k) {
    trace.time_s.push_back(path[k].time_s);
    trace.north_m.push_back(path[k].position_m.x());
    trace.east_m.push_back(path[k].position_m.y());
    trace.heading_deg.push_back(path[k].heading_rad * base::kDegreesPerRadian);
    measured_rad += base::wrapped(readings[k].heading_rad - measured_rad);
    trace.measured_deg.push_back(measured_rad * base::kDegreesPerRadian);
  }
  for (int heading_deg = 0; heading_deg <= 360; heading_deg += kStep_deg) {
    const double heading_rad = heading_deg * base::kRadiansPerDegree;
    trace.circle_deg.push_back(heading_deg);
    trace.injected_deg.push_back(curve_deg(truth, heading_rad));
    trace.thesis_deg.push_back(curve_deg(least_squares, heading_rad));
    trace.navcal_deg.push_back(curve_deg(navcal, heading_rad));
    trace.thesis_error_deg.push_back(noisy ? curve_deg(truth - least_squares, heading_rad)
                                           : thesis::table_4_1_error_rad(least_squares, heading_rad) *
                                                 base::kDegreesPerRadian);
    trace.perfect_error_deg.push_back(thesis::table_4_1_error_rad(truth, heading_rad) * base::kDegreesPerRadian);
    trace.navcal_error_deg.push_back(curve_deg(truth - navcal, heading_rad));
  }
  return trace;
}

}  // namespace navcal::analysis

// SPDX-License-Identifier: Apache-2.0
#include "analysis/thesis/thesis_parts.h"
#include "base/angles.h"
#include "calib/thesis/printed_tables.h"
#include "calib/thesis/turn_monte_carlo.h"

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

}  // namespace navcal::analysis

// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "base/angles.h"
#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {
namespace {

constexpr std::array kDeviationNames{"B", "C", "D", "E"};

std::vector<ThesisEstimate> deviation_rows(const analysis::ThesisResults& results, std::size_t coefficient) {
  const auto c = static_cast<Eigen::Index>(coefficient);
  std::vector<ThesisEstimate> rows;
  for (std::size_t i = 0; i < results.compass.size(); ++i) {
    const analysis::ThesisCompass& ours = results.compass.at(i);
    const calib::thesis::PrintedCompass& printed = calib::thesis::kTable4_1.at(i);
    ThesisEstimate row;
    row.truth = calib::thesis::thesis_deviation()[c + 1] * base::kDegreesPerRadian;
    row.percent_of = row.truth;
    row.printed = printed.deviation_deg.at(coefficient);
    row.printed_percent = printed.percent.at(coefficient);
    row.recomputed = ours.least_squares[c] * base::kDegreesPerRadian;
    row.navcal = ours.navcal[c] * base::kDegreesPerRadian;
    row.method_rms = ours.least_squares_rms[c] * base::kDegreesPerRadian;
    row.navcal_rms = ours.navcal_rms[c] * base::kDegreesPerRadian;
    row.bound = ours.bound[c] * base::kDegreesPerRadian;
    rows.push_back(row);
  }
  return rows;
}

ThesisTablePart heading_error_part(const analysis::ThesisResults& results) {
  const auto& ours = results.compass;
  const auto& printed = calib::thesis::kTable4_1;
  using Row = std::size_t;
  return thesis_part(
      "heading_error", "Error of heading over the whole circle, degrees", ours.size(),
      {kThesisPathColumn,
       {"thesis_mean_deg", [&](Row i) { return printed.at(i).mean_deg; }},
       {"thesis_largest_deg", [&](Row i) { return printed.at(i).largest_deg; }},
       {"thesis_std_deg", [&](Row i) { return printed.at(i).std_deg; }},
       {"checked_mean_deg", [&](Row i) { return ours.at(i).printed_error.mean_deg; }},
       {"checked_largest_deg", [&](Row i) { return ours.at(i).printed_error.largest_deg; }},
       {"checked_std_deg", [&](Row i) { return ours.at(i).printed_error.std_deg; }},
       {"recomputed_mean_deg", [&](Row i) { return ours.at(i).least_squares_error.mean_deg; }},
       {"recomputed_largest_deg", [&](Row i) { return ours.at(i).least_squares_error.largest_deg; }},
       {"recomputed_std_deg", [&](Row i) { return ours.at(i).least_squares_error.std_deg; }},
       {"navcal_largest_deg", [&](Row i) { return ours.at(i).navcal_error.largest_deg; }},
       {"noise_method_largest_deg", [&](Row i) { return ours.at(i).least_squares_noisy.largest_deg; }},
       {"noise_navcal_largest_deg", [&](Row i) { return ours.at(i).navcal_noisy.largest_deg; }}});
}

}  // namespace

ThesisTable thesis_compass_table(const analysis::ThesisResults& results) {
  ThesisTable table{"4.1", "Compass by least squares, with a calibrated gyro", {}};
  for (std::size_t c = 0; c < kDeviationNames.size(); ++c) {
    const double truth_deg =
        calib::thesis::thesis_deviation()[static_cast<Eigen::Index>(c) + 1] * base::kDegreesPerRadian;
    const std::string name = kDeviationNames.at(c);
    table.parts.push_back(thesis_estimates(
        name, name + ", true value " + std::to_string(static_cast<int>(std::lround(truth_deg))) + " degrees",
        deviation_rows(results, c)));
  }
  table.parts.push_back(heading_error_part(results));
  return table;
}

}  // namespace navcal::report

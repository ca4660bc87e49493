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
    row.path = static_cast<int>(i) + 1;
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

struct HeadingErrorRow {
  int path;
  const analysis::ThesisCompass* ours;
  const calib::thesis::PrintedCompass* printed;
};

ThesisColumnOf<HeadingErrorRow> error_column(const char* key, const char* head, int decimals,
                                             double (*get)(const HeadingErrorRow&)) {
  return {{key, head, decimals}, [get](const HeadingErrorRow& row) { return ThesisCell{get(row), {}}; }};
}

ThesisTablePart heading_error_part(const analysis::ThesisResults& results) {
  using Row = HeadingErrorRow;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < results.compass.size(); ++i)
    rows.push_back({static_cast<int>(i) + 1, &results.compass.at(i), &calib::thesis::kTable4_1.at(i)});
  const std::vector<ThesisColumnOf<Row>> columns{
      error_column("path", "path", 0, [](const Row& r) { return static_cast<double>(r.path); }),
      error_column("thesis_mean_deg", "thesis: mean", 4, [](const Row& r) { return r.printed->mean_deg; }),
      error_column("thesis_largest_deg", "max", 4, [](const Row& r) { return r.printed->largest_deg; }),
      error_column("thesis_std_deg", "std", 4, [](const Row& r) { return r.printed->std_deg; }),
      error_column("checked_mean_deg", "from its B..E: mean", 4,
                   [](const Row& r) { return r.ours->printed_error.mean_deg; }),
      error_column("checked_largest_deg", "max", 4,
                   [](const Row& r) { return r.ours->printed_error.largest_deg; }),
      error_column("checked_std_deg", "std", 4, [](const Row& r) { return r.ours->printed_error.std_deg; }),
      error_column("recomputed_mean_deg", "recomputed: mean", 4,
                   [](const Row& r) { return r.ours->least_squares_error.mean_deg; }),
      error_column("recomputed_largest_deg", "max", 4,
                   [](const Row& r) { return r.ours->least_squares_error.largest_deg; }),
      error_column("recomputed_std_deg", "std", 4,
                   [](const Row& r) { return r.ours->least_squares_error.std_deg; }),
      error_column("navcal_largest_deg", "navcal: max", 4,
                   [](const Row& r) { return r.ours->navcal_error.largest_deg; }),
      error_column("noise_method_largest_deg", "noise: method of the thesis, max", 2,
                   [](const Row& r) { return r.ours->least_squares_noisy.largest_deg; }),
      error_column("noise_navcal_largest_deg", "noise: navcal, max", 3,
                   [](const Row& r) { return r.ours->navcal_noisy.largest_deg; })};
  return thesis_part("heading_error", "Error of heading over the whole circle, degrees", rows, columns);
}

}  // namespace

ThesisTable thesis_compass_table(const analysis::ThesisResults& results) {
  ThesisTable table{"4.1",
                    "Compass by least squares, with a calibrated gyro",
                    "B to E in degrees. Percentages are 100 (estimate - true) / true with the sign of the true "
                    "value, as in this table of the thesis, but not in its tables 3.1 and 3.2. Columns thesis and "
                    "recomputed: deviation injected at the true heading, as the thesis did. All other columns: "
                    "psi = psi_m - E(psi_m), as its equation (2.8) says.",
                    {}};
  for (std::size_t c = 0; c < kDeviationNames.size(); ++c) {
    const double truth_deg =
        calib::thesis::thesis_deviation()[static_cast<Eigen::Index>(c) + 1] * base::kDegreesPerRadian;
    const std::string name = kDeviationNames.at(c);
    table.parts.push_back(thesis_estimates(
        name, name + ", true value " + std::to_string(static_cast<int>(std::lround(truth_deg))) + " degrees",
        deviation_rows(results, c), 4));
  }
  table.parts.push_back(heading_error_part(results));
  return table;
}

}  // namespace navcal::report

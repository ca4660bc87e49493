// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {
namespace {

using analysis::ThesisGyro;
using calib::thesis::PrintedGyro;

constexpr double kGyroTruth[2] = {calib::thesis::kTrueScale, calib::thesis::kTrueBias_rad_s};

/// Scale (0) or bias (1) of every path.
std::vector<ThesisEstimate> gyro_rows(const analysis::ThesisResults& results, bool adaptive, int coefficient) {
  std::vector<ThesisEstimate> rows;
  for (std::size_t i = 0; i < results.gyro.size(); ++i) {
    const ThesisGyro& ours = results.gyro.at(i);
    const PrintedGyro& printed = adaptive ? calib::thesis::kTable3_2.at(i) : calib::thesis::kTable3_1.at(i);
    ThesisEstimate row;
    row.truth = kGyroTruth[coefficient];
    row.percent_of = std::abs(row.truth);
    row.printed = coefficient == 0 ? printed.scale : printed.bias_rad_s;
    row.printed_percent = coefficient == 0 ? printed.scale_percent : printed.bias_percent;
    row.recomputed = (adaptive ? ours.adaptive : ours.least_squares)[coefficient];
    row.method_rms = (adaptive ? ours.adaptive_rms : ours.least_squares_rms)[coefficient];
    row.navcal = ours.navcal[coefficient];
    row.navcal_rms = ours.navcal_rms[coefficient];
    row.bound = ours.bound[coefficient];
    rows.push_back(row);
  }
  return rows;
}

std::vector<ThesisTablePart> gyro_parts(const analysis::ThesisResults& results, bool adaptive) {
  return {thesis_estimates("scale", "Scale abar, true value 1.1111", gyro_rows(results, adaptive, 0)),
          thesis_estimates("bias_rad_s", "Bias bbar, true value -0.1111 rad/s", gyro_rows(results, adaptive, 1))};
}

ThesisCell time_cell(const std::optional<double>& time_s) {
  return time_s ? ThesisCell(*time_s) : ThesisCell(std::string("not reached"));
}

ThesisTable convergence_table(const analysis::ThesisResults& results) {
  const auto& gyro = results.gyro;
  using Row = std::size_t;
  const auto error = [](const Eigen::Vector2d& estimate, int i) {
    return 100 * (estimate[i] - kGyroTruth[i]) / std::abs(kGyroTruth[i]);
  };
  const std::vector<ThesisColumnOf> columns{
      kThesisPathColumn,
      {"identifier_settled_s", [&](Row i) { return time_cell(gyro.at(i).adaptive_settled_s); }},
      {"noise_identifier_settled_s", [&](Row i) { return time_cell(gyro.at(i).adaptive_noisy_settled_s); }},
      {"identifier_scale_percent", [&](Row i) { return error(gyro.at(i).adaptive, 0); }},
      {"identifier_bias_percent", [&](Row i) { return error(gyro.at(i).adaptive, 1); }},
      {"navcal_settled_s", [&](Row i) { return time_cell(gyro.at(i).navcal_settled_s); }},
      {"noise_navcal_settled_s", [&](Row i) { return time_cell(gyro.at(i).navcal_noisy_settled_s); }},
      {"navcal_scale_percent", [&](Row i) { return error(gyro.at(i).navcal, 0); }},
      {"navcal_bias_percent", [&](Row i) { return error(gyro.at(i).navcal, 1); }}};
  return {
      "convergence", "Convergence of the adaptive identifier", {thesis_part("paths", "", gyro.size(), columns)}};
}

}  // namespace

std::vector<ThesisTable> thesis_gyro_tables(const analysis::ThesisResults& results) {
  return {{"3.1", "Gyro by least squares", gyro_parts(results, false)},
          {"3.2", "Gyro by the adaptive identifier", gyro_parts(results, true)},
          convergence_table(results)};
}

}  // namespace navcal::report

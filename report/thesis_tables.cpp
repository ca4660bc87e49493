// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>

#include "base/angles.h"
#include "base/text_rows.h"
#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {

const char* column_rows();  // thesis_columns.txt: "key decimals: head"

namespace {

using Row = std::size_t;

/// A column with the way to its cell in a row.
struct ColumnOf {
  std::string key;  ///< in thesis_columns.txt
  std::function<ThesisCell(std::size_t row)> get;
};
/// Numbers of the paths.
const ColumnOf kPathColumn{"path", [](std::size_t row) { return static_cast<double>(row) + 1; }};

ThesisColumn column_of(const std::string& key) {
  for (const auto& [about, head] : base::text_rows(column_rows(), ": ")) {
    if (about.substr(0, about.size() - 2) == key) return {key, std::string(head), about.back() - '0'};
  }
  throw std::logic_error("no column " + key);
}

ThesisTablePart table_part(std::string key, std::string title, std::size_t rows,
                           const std::vector<ColumnOf>& columns) {
  ThesisTablePart part{std::move(key), std::move(title), {}, {}};
  for (const auto& column : columns) part.columns.push_back(column_of(column.key));
  for (std::size_t row = 0; row < rows; ++row) {
    auto& cells = part.rows.emplace_back();
    for (const auto& column : columns) cells.push_back(column.get(row));
  }
  return part;
}

/// Estimates of one coefficient on one path, in its own unit.
struct Estimate {
  double truth = 0;
  double printed = 0, printed_percent = 0;
  double recomputed = 0;                  ///< by the method of the thesis, no noise
  double navcal = 0;                      ///< no noise
  double method_rms = 0, navcal_rms = 0;  ///< with noise
  double bound = 0;
  double percent_of = 1;  ///< what errors are percentages of: the true value or its amount
};

double percent(const Estimate& row, double error) { return 100 * error / row.percent_of; }
double size_percent(const Estimate& row, double error) { return std::abs(percent(row, error)); }

/// The columns that tables 3.1, 3.2 and 4.1 have in common.
ThesisTablePart estimates_part(std::string key, std::string title, const std::vector<Estimate>& rows) {
  return table_part(
      std::move(key), std::move(title), rows.size(),
      {kPathColumn,
       {"thesis", [&](Row i) { return rows[i].printed; }},
       {"thesis_percent", [&](Row i) { return rows[i].printed_percent; }},
       {"recomputed", [&](Row i) { return rows[i].recomputed; }},
       {"recomputed_percent", [&](Row i) { return percent(rows[i], rows[i].recomputed - rows[i].truth); }},
       {"navcal", [&](Row i) { return rows[i].navcal; }},
       {"navcal_percent", [&](Row i) { return percent(rows[i], rows[i].navcal - rows[i].truth); }},
       {"noise_method_percent", [&](Row i) { return size_percent(rows[i], rows[i].method_rms); }},
       {"noise_navcal_percent", [&](Row i) { return size_percent(rows[i], rows[i].navcal_rms); }},
       {"bound_percent", [&](Row i) { return size_percent(rows[i], rows[i].bound); }},
       {"thesis_bounds", [&](Row i) { return std::abs(rows[i].printed - rows[i].truth) / rows[i].bound; }},
       {"noise_method_bounds", [&](Row i) { return rows[i].method_rms / rows[i].bound; }},
       {"noise_navcal_bounds", [&](Row i) { return rows[i].navcal_rms / rows[i].bound; }}});
}

constexpr double kGyroTruth[2] = {calib::thesis::kTrueScale, calib::thesis::kTrueBias_rad_s};

/// Scale (0) or bias (1) of every path.
std::vector<Estimate> gyro_rows(const analysis::ThesisResults& results, bool adaptive, int coefficient) {
  std::vector<Estimate> rows;
  for (std::size_t i = 0; i < results.gyro.size(); ++i) {
    const analysis::ThesisGyro& ours = results.gyro.at(i);
    const auto& printed = adaptive ? calib::thesis::kTable3_2.at(i) : calib::thesis::kTable3_1.at(i);
    Estimate row;
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
  return {estimates_part("scale", "Scale abar, true value 1.1111", gyro_rows(results, adaptive, 0)),
          estimates_part("bias_rad_s", "Bias bbar, true value -0.1111 rad/s", gyro_rows(results, adaptive, 1))};
}

ThesisCell time_cell(const std::optional<double>& time_s) {
  return time_s ? ThesisCell(*time_s) : ThesisCell(std::string("not reached"));
}

ThesisTable convergence_table(const analysis::ThesisResults& results) {
  const auto& gyro = results.gyro;
  const auto error = [](const Eigen::Vector2d& estimate, int i) {
    return 100 * (estimate[i] - kGyroTruth[i]) / std::abs(kGyroTruth[i]);
  };
  const std::vector<ColumnOf> columns{
      kPathColumn,
      {"identifier_settled_s", [&](Row i) { return time_cell(gyro.at(i).adaptive_settled_s); }},
      {"noise_identifier_settled_s", [&](Row i) { return time_cell(gyro.at(i).adaptive_noisy_settled_s); }},
      {"identifier_scale_percent", [&](Row i) { return error(gyro.at(i).adaptive, 0); }},
      {"identifier_bias_percent", [&](Row i) { return error(gyro.at(i).adaptive, 1); }},
      {"navcal_settled_s", [&](Row i) { return time_cell(gyro.at(i).navcal_settled_s); }},
      {"noise_navcal_settled_s", [&](Row i) { return time_cell(gyro.at(i).navcal_noisy_settled_s); }},
      {"navcal_scale_percent", [&](Row i) { return error(gyro.at(i).navcal, 0); }},
      {"navcal_bias_percent", [&](Row i) { return error(gyro.at(i).navcal, 1); }}};
  return {
      "convergence", "Convergence of the adaptive identifier", {table_part("paths", "", gyro.size(), columns)}};
}

constexpr std::array kDeviationNames{"B", "C", "D", "E"};

std::vector<Estimate> deviation_rows(const analysis::ThesisResults& results, std::size_t coefficient) {
  const auto c = static_cast<Eigen::Index>(coefficient);
  std::vector<Estimate> rows;
  for (std::size_t i = 0; i < results.compass.size(); ++i) {
    const analysis::ThesisCompass& ours = results.compass.at(i);
    const calib::thesis::PrintedCompass& printed = calib::thesis::kTable4_1.at(i);
    Estimate row;
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
  return table_part(
      "heading_error", "Error of heading over the whole circle, degrees", ours.size(),
      {kPathColumn,
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

ThesisTable compass_table(const analysis::ThesisResults& results) {
  ThesisTable table{"4.1", "Compass by least squares, with a calibrated gyro", {}};
  for (std::size_t c = 0; c < kDeviationNames.size(); ++c) {
    const double truth_deg =
        calib::thesis::thesis_deviation()[static_cast<Eigen::Index>(c) + 1] * base::kDegreesPerRadian;
    const std::string name = kDeviationNames.at(c);
    table.parts.push_back(estimates_part(
        name, name + ", true value " + std::to_string(static_cast<int>(std::lround(truth_deg))) + " degrees",
        deviation_rows(results, c)));
  }
  table.parts.push_back(heading_error_part(results));
  return table;
}

ThesisTable circle_table(const analysis::ThesisResults& results) {
  const auto& ours = results.circles;
  const auto& printed = calib::thesis::kTable4_2;
  const std::vector<ColumnOf> columns{
      {"figure", [&](Row i) { return std::string(printed.at(i).figure); }},
      {"shift_x_uT", [&](Row i) { return printed.at(i).shift_x_uT; }},
      {"shift_y_uT", [&](Row i) { return printed.at(i).shift_y_uT; }},
      {"eccentricity", [&](Row i) { return printed.at(i).eccentricity; }},
      {"axis_deg", [&](Row i) { return printed.at(i).axis_deg; }},
      {"noise", [&](Row i) { return std::string(printed.at(i).noise ? "0.1 uT" : "no"); }},
      {"thesis_raw_axis_deg",
       [&](Row i) {
         const auto& axis = printed.at(i).raw_axis_deg;
         return axis[0] < axis[1] ? fmt::format("{:.0f} to {:.0f}", axis[0], axis[1]) : std::string();
       }},
      {"raw_least_deg", [&](Row i) { return ours.at(i).raw_deg[0]; }},
      {"raw_largest_deg", [&](Row i) { return ours.at(i).raw_deg[1]; }},
      {"thesis_residual_deg", [&](Row i) { return printed.at(i).residual_axis_deg; }},
      {"recomputed_residual_deg", [&](Row i) { return ours.at(i).residual_deg; }},
      {"recomputed_calibration_deg", [&](Row i) { return ours.at(i).thesis_deg; }},
      {"navcal_calibration_deg", [&](Row i) { return ours.at(i).navcal_deg; }},
      {"noise_method_rms_deg", [&](Row i) { return ours.at(i).thesis_rms_deg; }},
      {"noise_navcal_rms_deg", [&](Row i) { return ours.at(i).navcal_rms_deg; }},
      {"bound_deg", [&](Row i) { return ours.at(i).bound_deg; }},
      {"noise_method_bounds", [&](Row i) { return ours.at(i).thesis_rms_deg / ours.at(i).bound_deg; }},
      {"noise_navcal_bounds", [&](Row i) { return ours.at(i).navcal_rms_deg / ours.at(i).bound_deg; }}};
  return {"4.2", "Magnetometer: shifted and flattened circles", {table_part("figures", "", ours.size(), columns)}};
}

ThesisTablePart field_path_part(const std::string& figure,
                                const std::array<analysis::ThesisFieldPath, analysis::kThesisPaths>& paths) {
  return table_part(
      "figure_" + figure, "Distortion of figure " + figure, paths.size(),
      {kPathColumn,
       {"recomputed_deg", [&](Row i) { return paths.at(i).thesis_deg; }},
       {"noise_method_deg", [&](Row i) { return paths.at(i).thesis_noisy_deg; }},
       {"noise_navcal_deg", [&](Row i) { return paths.at(i).navcal_noisy_deg; }},
       {"noise_navcal_rms_deg", [&](Row i) { return paths.at(i).navcal_rms_deg; }},
       {"bound_deg", [&](Row i) { return paths.at(i).bound_deg; }},
       {"noise_navcal_bounds", [&](Row i) { return paths.at(i).navcal_rms_deg / paths.at(i).bound_deg; }}});
}

}  // namespace

std::string shown_cell(const ThesisCell& cell, const ThesisColumn& column) {
  if (!cell.number) return cell.text.empty() ? "-" : cell.text;
  const std::string text = fmt::format("{:.{}f}", *cell.number, column.decimals);
  // No negative zero.
  const bool zero = text.find_first_of("123456789") == std::string::npos && text.front() == '-';
  return zero ? text.substr(1) : text;
}

std::vector<ThesisTable> thesis_tables(const analysis::ThesisResults& results) {
  std::vector<ThesisTable> tables{
      {"3.1", "Gyro by least squares", gyro_parts(results, false)},
      {"3.2", "Gyro by the adaptive identifier", gyro_parts(results, true)},
      convergence_table(results),
      compass_table(results),
      circle_table(results),
      {"magnetometer-paths",
       "Magnetometer on the eight paths",
       {field_path_part("4.11", results.field_paths[0]), field_path_part("4.12", results.field_paths[1])}}};
  for (ThesisTable& table : tables) table.words = thesis_caption("table-" + table.id);
  return tables;
}

}  // namespace navcal::report

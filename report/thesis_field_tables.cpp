// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {
namespace {

ThesisTable circle_table(const analysis::ThesisResults& results) {
  const auto& ours = results.circles;
  const auto& printed = calib::thesis::kTable4_2;
  using Row = std::size_t;
  const std::vector<ThesisColumnOf> columns{
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
  return {
      "4.2", "Magnetometer: shifted and flattened circles", {thesis_part("figures", "", ours.size(), columns)}};
}

ThesisTablePart field_path_part(const std::string& figure,
                                const std::array<analysis::ThesisFieldPath, analysis::kThesisPaths>& paths) {
  using Row = std::size_t;
  return thesis_part(
      "figure_" + figure, "Distortion of figure " + figure, paths.size(),
      {kThesisPathColumn,
       {"recomputed_deg", [&](Row i) { return paths.at(i).thesis_deg; }},
       {"noise_method_deg", [&](Row i) { return paths.at(i).thesis_noisy_deg; }},
       {"noise_navcal_deg", [&](Row i) { return paths.at(i).navcal_noisy_deg; }},
       {"noise_navcal_rms_deg", [&](Row i) { return paths.at(i).navcal_rms_deg; }},
       {"bound_deg", [&](Row i) { return paths.at(i).bound_deg; }},
       {"noise_navcal_bounds", [&](Row i) { return paths.at(i).navcal_rms_deg / paths.at(i).bound_deg; }}});
}

}  // namespace

std::vector<ThesisTable> thesis_field_tables(const analysis::ThesisResults& results) {
  return {circle_table(results),
          {"magnetometer-paths",
           "Magnetometer on the eight paths",
           {field_path_part("4.11", results.field_paths[0]), field_path_part("4.12", results.field_paths[1])}}};
}

}  // namespace navcal::report

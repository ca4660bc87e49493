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
      {{"figure", "figure", 0}, [&](Row i) { return std::string(printed.at(i).figure); }},
      {{"shift_x_uT", "shift forward, uT", 1}, [&](Row i) { return printed.at(i).shift_x_uT; }},
      {{"shift_y_uT", "starboard, uT", 1}, [&](Row i) { return printed.at(i).shift_y_uT; }},
      {{"eccentricity", "eccentricity", 1}, [&](Row i) { return printed.at(i).eccentricity; }},
      {{"axis_deg", "axis, deg", 0}, [&](Row i) { return printed.at(i).axis_deg; }},
      {{"noise", "noise", 0}, [&](Row i) { return std::string(printed.at(i).noise ? "0.1 uT" : "no"); }},
      {{"thesis_raw_axis_deg", "thesis: raw error within", 0},
       [&](Row i) {
         const auto& axis = printed.at(i).raw_axis_deg;
         return axis[0] < axis[1] ? fmt::format("{:.0f} to {:.0f}", axis[0], axis[1]) : std::string();
       }},
      {{"raw_least_deg", "raw error: least", 2}, [&](Row i) { return ours.at(i).raw_deg[0]; }},
      {{"raw_largest_deg", "largest", 2}, [&](Row i) { return ours.at(i).raw_deg[1]; }},
      {{"thesis_residual_deg", "thesis: residual within", 2},
       [&](Row i) { return printed.at(i).residual_axis_deg; }},
      {{"recomputed_residual_deg", "recomputed: residual", 3}, [&](Row i) { return ours.at(i).residual_deg; }},
      {{"recomputed_calibration_deg", "recomputed: calibration alone", 4},
       [&](Row i) { return ours.at(i).thesis_deg; }},
      {{"navcal_calibration_deg", "navcal: calibration alone", 4}, [&](Row i) { return ours.at(i).navcal_deg; }},
      {{"noise_method_rms_deg", "noise: method of the thesis, rms", 4},
       [&](Row i) { return ours.at(i).thesis_rms_deg; }},
      {{"noise_navcal_rms_deg", "noise: navcal, rms", 4}, [&](Row i) { return ours.at(i).navcal_rms_deg; }},
      {{"bound_deg", "bound, rms", 4}, [&](Row i) { return ours.at(i).bound_deg; }},
      {{"noise_method_bounds", "method / bound", 1},
       [&](Row i) { return ours.at(i).thesis_rms_deg / ours.at(i).bound_deg; }},
      {{"noise_navcal_bounds", "navcal / bound", 2},
       [&](Row i) { return ours.at(i).navcal_rms_deg / ours.at(i).bound_deg; }}};
  return {
      "4.2",
      "Magnetometer: shifted and flattened circles",
      "Errors of heading in degrees. The thesis prints the distortions; its errors are the limits of the axes of "
      "its figures. Residual: largest error of a calibrated sample, noise included. Calibration alone: largest "
      "error that the calibration makes of a field without noise. The columns with noise have 0.1 uT in every "
      "row, and are root mean squares over the circle and the runs. Medians over the runs in figure 4.12.",
      {thesis_part("figures", "", ours.size(), columns)}};
}

ThesisTablePart field_path_part(const std::string& figure,
                                const std::array<analysis::ThesisFieldPath, analysis::kThesisPaths>& paths) {
  using Row = std::size_t;
  return thesis_part(
      "figure_" + figure, "Distortion of figure " + figure, paths.size(),
      {kThesisPathColumn,
       {{"recomputed_deg", "method of the thesis", 2}, [&](Row i) { return paths.at(i).thesis_deg; }},
       {{"noise_method_deg", "noise: method of the thesis", 2},
        [&](Row i) { return paths.at(i).thesis_noisy_deg; }},
       {{"noise_navcal_deg", "noise: navcal", 3}, [&](Row i) { return paths.at(i).navcal_noisy_deg; }},
       {{"noise_navcal_rms_deg", "noise: navcal, rms", 4}, [&](Row i) { return paths.at(i).navcal_rms_deg; }},
       {{"bound_deg", "bound, rms", 4}, [&](Row i) { return paths.at(i).bound_deg; }},
       {{"noise_navcal_bounds", "navcal / bound", 2},
        [&](Row i) { return paths.at(i).navcal_rms_deg / paths.at(i).bound_deg; }}});
}

}  // namespace

std::vector<ThesisTable> thesis_field_tables(const analysis::ThesisResults& results) {
  return {circle_table(results),
          {"magnetometer-paths",
           "Magnetometer on the eight paths",
           "The thesis leaves this comparison to future work (section 4.4). Largest error over the circle that "
           "the calibration makes of a field without noise, degrees; medians over the runs. The mean and the two "
           "largest samples need whole circles at a constant rate, which only path 7 comes near.",
           {field_path_part("4.11", results.field_paths[0]), field_path_part("4.12", results.field_paths[1])}}};
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {
namespace {

struct CircleRow {
  const analysis::ThesisCircle* ours;
  const calib::thesis::PrintedCircle* printed;
};

ThesisColumnOf<CircleRow> circle_column(const char* key, const char* head, int decimals,
                                        double (*get)(const CircleRow&)) {
  return {{key, head, decimals}, [get](const CircleRow& row) { return ThesisCell{get(row), {}}; }};
}

ThesisColumnOf<CircleRow> circle_text(const char* key, const char* head, std::string (*get)(const CircleRow&)) {
  return {{key, head, 0}, [get](const CircleRow& row) { return ThesisCell{std::nullopt, get(row)}; }};
}

ThesisTable circle_table(const analysis::ThesisResults& results) {
  using Row = CircleRow;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < results.circles.size(); ++i)
    rows.push_back({&results.circles.at(i), &calib::thesis::kTable4_2.at(i)});
  const std::vector<ThesisColumnOf<Row>> columns{
      circle_text("figure", "figure", [](const Row& r) { return std::string(r.printed->figure); }),
      circle_column("shift_x_uT", "shift forward, uT", 1, [](const Row& r) { return r.printed->shift_x_uT; }),
      circle_column("shift_y_uT", "starboard, uT", 1, [](const Row& r) { return r.printed->shift_y_uT; }),
      circle_column("eccentricity", "eccentricity", 1, [](const Row& r) { return r.printed->eccentricity; }),
      circle_column("axis_deg", "axis, deg", 0, [](const Row& r) { return r.printed->axis_deg; }),
      circle_text("noise", "noise", [](const Row& r) { return std::string(r.printed->noise ? "0.1 uT" : "no"); }),
      circle_text("thesis_raw_axis_deg", "thesis: raw error within",
                  [](const Row& r) {
                    const auto& axis = r.printed->raw_axis_deg;
                    return axis[0] < axis[1] ? fmt::format("{:.0f} to {:.0f}", axis[0], axis[1]) : std::string();
                  }),
      circle_column("raw_least_deg", "raw error: least", 2, [](const Row& r) { return r.ours->raw_deg[0]; }),
      circle_column("raw_largest_deg", "largest", 2, [](const Row& r) { return r.ours->raw_deg[1]; }),
      circle_column("thesis_residual_deg", "thesis: residual within", 2,
                    [](const Row& r) { return r.printed->residual_axis_deg; }),
      circle_column("recomputed_residual_deg", "recomputed: residual", 3,
                    [](const Row& r) { return r.ours->residual_deg; }),
      circle_column("recomputed_calibration_deg", "recomputed: calibration alone", 4,
                    [](const Row& r) { return r.ours->thesis_deg; }),
      circle_column("navcal_calibration_deg", "navcal: calibration alone", 4,
                    [](const Row& r) { return r.ours->navcal_deg; }),
      circle_column("noise_method_rms_deg", "noise: method of the thesis, rms", 4,
                    [](const Row& r) { return r.ours->thesis_rms_deg; }),
      circle_column("noise_navcal_rms_deg", "noise: navcal, rms", 4,
                    [](const Row& r) { return r.ours->navcal_rms_deg; }),
      circle_column("bound_deg", "bound, rms", 4, [](const Row& r) { return r.ours->bound_deg; }),
      circle_column("noise_method_bounds", "method / bound", 1,
                    [](const Row& r) { return r.ours->thesis_rms_deg / r.ours->bound_deg; }),
      circle_column("noise_navcal_bounds", "navcal / bound", 2,
                    [](const Row& r) { return r.ours->navcal_rms_deg / r.ours->bound_deg; })};
  return {
      "4.2",
      "Magnetometer: shifted and flattened circles",
      "Errors of heading in degrees. The thesis prints the distortions; its errors are the limits of the axes "
      "of its figures. Residual: largest error of a calibrated sample, noise included. Calibration alone: "
      "largest error that the calibration makes of a field without noise. The columns with noise have 0.1 uT in "
      "every row, and are root mean squares over the circle and the runs. Medians over the runs in figure 4.12.",
      {thesis_part("figures", "", rows, columns)}};
}

struct FieldPathRow {
  int path;
  const analysis::ThesisFieldPath* ours;
};

ThesisTablePart field_path_part(const std::string& figure,
                                const std::array<analysis::ThesisFieldPath, analysis::kThesisPaths>& paths) {
  using Row = FieldPathRow;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < paths.size(); ++i) rows.push_back({static_cast<int>(i) + 1, &paths.at(i)});
  const std::vector<ThesisColumnOf<Row>> columns{
      {{"path", "path", 0},
       [](const Row& r) {
         return ThesisCell{r.path, {}};
       }},
      {{"recomputed_deg", "method of the thesis", 2},
       [](const Row& r) {
         return ThesisCell{r.ours->thesis_deg, {}};
       }},
      {{"noise_method_deg", "noise: method of the thesis", 2},
       [](const Row& r) {
         return ThesisCell{r.ours->thesis_noisy_deg, {}};
       }},
      {{"noise_navcal_deg", "noise: navcal", 3},
       [](const Row& r) {
         return ThesisCell{r.ours->navcal_noisy_deg, {}};
       }},
      {{"noise_navcal_rms_deg", "noise: navcal, rms", 4},
       [](const Row& r) {
         return ThesisCell{r.ours->navcal_rms_deg, {}};
       }},
      {{"bound_deg", "bound, rms", 4},
       [](const Row& r) {
         return ThesisCell{r.ours->bound_deg, {}};
       }},
      {{"noise_navcal_bounds", "navcal / bound", 2}, [](const Row& r) {
         return ThesisCell{r.ours->navcal_rms_deg / r.ours->bound_deg, {}};
       }}};
  return thesis_part("figure_" + figure, "Distortion of figure " + figure, rows, columns);
}

}  // namespace

std::vector<ThesisTable> thesis_field_tables(const analysis::ThesisResults& results) {
  return {
      circle_table(results),
      {"magnetometer-paths",
       "Magnetometer on the eight paths",
       "The thesis leaves this comparison to future work (section 4.4). Largest error over the circle that the "
       "calibration makes of a field without noise, degrees; medians over the runs. The mean and the two "
       "largest samples need whole circles at a constant rate, which only path 7 comes near.",
       {field_path_part("4.11", results.field_paths[0]), field_path_part("4.12", results.field_paths[1])}}};
}

}  // namespace navcal::report

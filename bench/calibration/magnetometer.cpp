// SPDX-License-Identifier: Apache-2.0
#include "bench/calibration/magnetometer.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "calib/magnetometer/ellipse_estimator.h"
#include "calib/thesis/distorted_field.h"
#include "tests/calib/level_field.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::bench {

using namespace calib;
using namespace calib::thesis;
using calib::test::load_true_path;

namespace {

/// Best figures that were known of paths 1 to 8, and goals.
struct Printed {
  std::array<double, 8> best, goal;
};
constexpr Printed kPrinted_4_11{{0.04, 0.05, 0.08, 0.10, 0.04, 0.05, 0.04, 0.05},
                                {0.06, 0.06, 0.11, 0.13, 0.06, 0.07, 0.06, 0.06}};
constexpr Printed kPrinted_4_12{{0.06, 0.06, 0.11, 0.11, 0.06, 0.06, 0.05, 0.05},
                                {0.08, 0.08, 0.15, 0.15, 0.08, 0.08, 0.07, 0.08}};

/// Results of one method over the runs of a row.
struct Tally {
  std::vector<double> largest_deg;
  double square_deg2 = 0;
  std::size_t within = 0, numbers = 0;

  void add(const FieldCorrection& found, const EllipseShape& shape, const EllipseShape::Matrix& covariance,
           const EllipseShape& truth) {
    const HeadingError error = heading_error(found, truth);
    largest_deg.push_back(error.largest_deg);
    square_deg2 += error.rms_deg * error.rms_deg;
    EllipseShape::Vector off;
    off << shape.centre_uT - truth.centre_uT, shape.axes_uT(0, 0) - truth.axes_uT(0, 0),
        shape.axes_uT(0, 1) - truth.axes_uT(0, 1), shape.axes_uT(1, 1) - truth.axes_uT(1, 1);
    for (int i = 0; i < EllipseShape::kParameters; ++i) {
      numbers += 1;
      within += std::abs(off[i]) <= 2 * std::sqrt(covariance(i, i));
    }
  }
  [[nodiscard]] double median_deg() {
    if (largest_deg.empty()) return NAN;
    const auto middle = largest_deg.begin() + static_cast<std::ptrdiff_t>(largest_deg.size() / 2);
    std::nth_element(largest_deg.begin(), middle, largest_deg.end());
    return *middle;
  }
  [[nodiscard]] double rms_deg() const {
    return std::sqrt(square_deg2 / static_cast<double>(std::max<std::size_t>(1, largest_deg.size())));
  }
  [[nodiscard]] double coverage() const {
    return 100.0 * static_cast<double>(within) / static_cast<double>(std::max<std::size_t>(1, numbers));
  }
};

double thesis_error_deg(const std::vector<FieldReading>& readings, const EllipseShape& truth) {
  std::vector<Eigen::Vector2d> field;
  for (const auto& reading : readings) field.emplace_back(reading.field_body_uT.head<2>());
  const auto moments = thesis::CircleMoments::fit(field);
  if (!moments) return NAN;
  FieldCorrection correction;
  correction.offset_uT.head<2>() = moments->centre_uT;
  correction.matrix.topLeftCorner<2, 2>() = moments->matrix;
  return heading_error(correction, truth).largest_deg;
}

void add_gyro(Tally& tally, const EllipseGyro::Parameters& parameters, const std::vector<FieldReading>& readings,
              const EllipseShape& truth) {
  EllipseGyro gyro(parameters);
  for (const auto& r : readings) gyro.update(r.field_body_uT, r.roll_rad, r.pitch_rad, r.turn);
  gyro.settle();
  if (gyro.shape())
    tally.add(gyro.estimate()->correction, *gyro.shape(), gyro.covariance().topLeftCorner<5, 5>(), truth);
}

struct Pooled {
  std::array<double, 3> within{}, numbers{};
  std::array<double, 3> worst_ratio{};
};

void print_row(int number, const EllipseShape& truth, const Printed& printed, int runs, Pooled& pooled) {
  const auto path = load_true_path("path" + std::to_string(number));
  const auto index = static_cast<std::size_t>(number - 1);
  Random random(static_cast<std::uint64_t>(number));
  const double no_noise = thesis_error_deg(level_field_on(path, truth, kNoNoise, random), truth);
  std::array<Tally, 3> tallies;
  std::vector<double> thesis;
  for (int run = 0; run < runs; ++run) {
    const auto readings = level_field_on(path, truth, Noise{}, random);
    thesis.push_back(thesis_error_deg(readings, truth));
    EllipseEstimator ellipse(ellipse_parameters());
    for (const auto& r : readings) ellipse.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
    ellipse.settle();
    if (ellipse.fit()) {
      tallies[0].add(ellipse.estimate()->correction, ellipse.fit()->shape, ellipse.fit()->covariance, truth);
    }
    add_gyro(tallies[1], gyro_parameters(false), readings, truth);
    add_gyro(tallies[2], gyro_parameters(true), readings, truth);
  }
  std::nth_element(thesis.begin(), thesis.begin() + runs / 2, thesis.end());
  const std::array bounds{ellipse_bound_deg(path, truth), gyro_bound_deg(path, truth, false),
                          gyro_bound_deg(path, truth, true)};
  double best = INFINITY;
  std::string ours;
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    Tally& tally = tallies[i];
    const double ratio = tally.rms_deg() / bounds[i];
    ours += fmt::format(" {:.3f} | {:.3f} / {:.3f} = {:.2f} | {:.1f} |", tally.median_deg(), tally.rms_deg(),
                        bounds[i], ratio, tally.coverage());
    best = std::min(best, tally.median_deg());
    pooled.within[i] += static_cast<double>(tally.within);
    pooled.numbers[i] += static_cast<double>(tally.numbers);
    pooled.worst_ratio[i] = std::max(pooled.worst_ratio[i], ratio);
  }
  fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |{} {} |\n", number, no_noise,
             thesis[static_cast<std::size_t>(runs / 2)], printed.best[index], printed.goal[index], ours,
             best <= printed.goal[index] ? "reached" : "missed");
}

void print_figure(const char* figure, const EllipseShape& truth, const Printed& printed, int runs) {
  fmt::print(
      "Figure {}, {} runs: median of the largest error of heading (degrees); root-mean-square over circle and "
      "runs, "
      "its Cramer-Rao bound and their ratio; share of the five parameters within two standard deviations (%).\n\n",
      figure, runs);
  fmt::print(
      "| path | thesis, no noise | thesis | best | goal | ellipse | rms / bound | 2 sigma | with gyro | rms / "
      "bound | "
      "2 sigma | gyro unknown | rms / bound | 2 sigma | goal |\n|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|\n");
  Pooled pooled;
  for (int path = 1; path <= 8; ++path) print_row(path, truth, printed, runs, pooled);
  for (std::size_t i = 0; i < 3; ++i) {
    fmt::print("{}{}: {:.2f} % within two standard deviations over all paths, worst ratio {:.2f}",
               i == 0 ? "\n" : "; ", std::array{"ellipse", "with gyro", "gyro unknown"}[i],
               100 * pooled.within[i] / pooled.numbers[i], pooled.worst_ratio[i]);
  }
  fmt::print(".\n\n");
}

}  // namespace

void print_magnetometer(const TableOptions& options) {
  print_figure("4.11", figure_4_11(), kPrinted_4_11, options.runs);
  print_figure("4.12", figure_4_12(), kPrinted_4_12, options.runs);
}

}  // namespace navcal::bench

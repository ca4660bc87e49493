// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "bench/calibration/gps_delay_tables.h"
#include "calib/gps/gps_compass.h"
#include "tests/calib/gps/gps_course_fit.h"
#include "tests/calib/gps_paths.h"

namespace navcal::bench {
namespace {

using namespace calib;
using namespace calib::test;

constexpr double kDegrees = 180 / std::numbers::pi;

struct Column {
  const char* name;
  GpsNoise noise;
  double current_m_s = 0;  ///< from a direction that differs from run to run
};
const std::array<Column, 3> kColumns{
    {{"a", {.interval_s = 0.1}},
     {"b", {.interval_s = 1, .velocity_std_m_s = 0.05, .position_std_m = 0.5, .heading_std_rad = 0.004}},
     {"c", {.interval_s = 1, .velocity_std_m_s = 0.10, .position_std_m = 2, .heading_std_rad = 0.004}, 0.15}}};

/// THESIS 11.5: course least squares and E5 for a, b and c.
struct Row {
  const char* path;
  std::array<double, 6> thesis;
};
constexpr std::array<Row, 9> kRows{{{"path1", {3.31, 0.27, 4.23, 1.77, 11.90, 3.34}},
                                    {"path2", {1.09, 0.14, 1.91, 1.61, 9.94, 3.29}},
                                    {"path3", {0.55, 0.41, 3.35, 3.27, 11.17, 5.63}},
                                    {"path4", {0.94, 0.35, 9.13, 6.57, 18.53, 7.82}},
                                    {"path5", {2.24, 0.15, 2.59, 1.13, 7.83, 2.22}},
                                    {"path6", {2.92, 0.20, 3.49, 1.29, 8.40, 2.64}},
                                    {"path7", {7.37, 1.52, 8.59, 2.65, 16.62, 3.84}},
                                    {"path8", {1.68, 0.42, 3.25, 2.41, 13.97, 4.77}},
                                    {"path_long600", {0.29, 0.05, 0.58, 0.21, 8.77, 0.64}}}};

GpsCompass::Parameters parameters_for(const GpsNoise& noise) {
  GpsCompass::Parameters parameters;
  parameters.summary.velocity_std_m_s = std::max(noise.velocity_std_m_s, 0.002);
  parameters.summary.position_std_m = std::max(noise.position_std_m, 0.01);
  // The speed is the path's own here, so that only the slip is not quite as modelled.
  parameters.summary.model_std_m_s = 0.003;
  // Priors as large as the injected deviations.
  parameters.deviation_std_rad = parameters.offset_std_rad = 0.1;
  return parameters;
}

using Vector9 = GpsCompass::Vector;
using Matrix9 = GpsCompass::Matrix;

/// Velocities and positions (from the first fix) that GpsCompass's model predicts at the fixes, written out anew.
std::vector<double> predicted(const Vector9& x, const GpsRun& run) {
  std::vector<double> seen;
  Eigen::Vector2d position = Eigen::Vector2d::Zero(), velocity = Eigen::Vector2d::Zero();
  std::size_t g = 0;
  for (std::size_t k = 0; k < run.track.size(); ++k) {
    const auto& track = run.track[k];
    const double psi =
        track.heading_rad - deviation_rad(x.head<5>(), track.heading_rad) + x[6] * track.turn_rate_rad_s;
    const Eigen::Vector2d now =
        x[5] * track.speed_m_s * Eigen::Vector2d(std::cos(psi), std::sin(psi)) + x.tail<2>();
    if (k > 0) position += (velocity + now) / 2 * (track.time_s - run.track[k - 1].time_s);
    velocity = now;
    if (g < run.ground.size() && run.ground[g].time_s <= track.time_s + 1e-9) {
      seen.insert(seen.end(), {now.x(), now.y(), position.x(), position.y()});
      ++g;
    }
  }
  return seen;
}

/// Cramer-Rao bound (with the priors) of A..E: covariance by differences of the predictions, the place of the
/// first fix unknown. Fixes below the least speed tell nothing.
Eigen::Matrix<double, 5, 5> bound(const GpsRun& run, const GpsCompass::Parameters& p) {
  Vector9 x;
  x << gps_deviation(), 1, -0.15, 0, 0;
  const std::size_t fixes = run.ground.size();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(4 * fixes), 11);
  for (int i = 0; i < 9; ++i) {
    constexpr double kStep = 1e-5;
    const auto up = predicted(x + kStep * Vector9::Unit(i), run),
               down = predicted(x - kStep * Vector9::Unit(i), run);
    for (std::size_t n = 0; n < up.size(); ++n)
      rows(static_cast<Eigen::Index>(n), i) = (up[n] - down[n]) / (2 * kStep);
  }
  for (std::size_t n = 0; n < fixes; ++n) {
    const auto at = static_cast<Eigen::Index>(4 * n);
    rows(at + 2, 9) = rows(at + 3, 10) = 1;
    const bool slow = run.ground[n].speed_m_s < p.summary.least_speed_m_s;
    rows.middleRows(at, 2) *= slow ? 0 : 1 / p.summary.velocity_std_m_s;
    rows.middleRows(at + 2, 2) *= slow ? 0 : 1 / p.summary.position_std_m;
  }
  Eigen::MatrixXd information = rows.transpose() * rows;
  Vector9 prior;
  prior << p.offset_std_rad, Eigen::Vector4d::Constant(p.deviation_std_rad), p.speed_scale_std, p.slip_std_s,
      p.current_std_m_s, p.current_std_m_s;
  information.diagonal().head<9>() += prior.array().square().inverse().matrix();
  information.diagonal().tail<2>().array() += 1e-9;
  return information.llt().solve(Eigen::MatrixXd::Identity(11, 11)).topLeftCorner<5, 5>();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

struct Result {
  double course = 0, ours = 0;  ///< medians of the greatest residual, deg
  double bound = 0;             ///< the same of errors drawn from the bound
  double ratio = 0;             ///< root-mean-square error of A..E over the bound's
  double covered = 0;           ///< share of A..E within two of their standard errors
};

Result measure_row(const std::vector<TruePoint>& path, const Column& column, int runs) {
  const auto parameters = parameters_for(column.noise);
  std::vector<double> course, ours, at_bound;
  double square = 0, bound_square = 0, within = 0;
  Eigen::LLT<Eigen::Matrix<double, 5, 5>> spread;
  for (int i = 0; i < runs; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 1);
    std::normal_distribution<double> normal;
    GpsNoise noise = column.noise;
    const double towards = 2.399963 * i;  // the golden angle: all directions alike
    noise.current_m_s = column.current_m_s * Eigen::Vector2d(std::cos(towards), std::sin(towards));
    const GpsRun run = measure_by_gps(path, gps_deviation(), noise, random);
    if (i == 0) spread.compute(bound(run, parameters));
    GpsCompass compass(parameters);
    GpsCourseFit fit;
    feed(compass, run);
    feed(fit, run);
    const auto estimate = compass.solve();
    if (!estimate) continue;
    const Deviation found = estimate->unknowns.head<5>();
    course.push_back(worst_residual_rad(fit.estimate(), gps_deviation()) * kDegrees);
    ours.push_back(worst_residual_rad(found, gps_deviation()) * kDegrees);
    Deviation draw;
    for (double& value : draw) value = normal(random);
    at_bound.push_back(worst_residual_rad(spread.matrixL() * draw, Deviation::Zero()) * kDegrees);
    const Deviation error = found - gps_deviation();
    const Eigen::Matrix<double, 5, 5> covariance = estimate->covariance.topLeftCorner<5, 5>();
    square += error.squaredNorm();
    bound_square += spread.matrixL().toDenseMatrix().squaredNorm();
    for (int k = 0; k < 5; ++k) within += std::abs(error[k]) <= 2 * std::sqrt(covariance(k, k)) ? 0.2 : 0;
  }
  const auto n = static_cast<double>(ours.size());
  return {median(course), median(ours), median(at_bound), std::sqrt(square / bound_square), within / n};
}

}  // namespace

void print_gps(const TableOptions& options) {
  fmt::print(
      "A..E by GPS (THESIS 11.5): median over {} runs of the greatest residual over the circle, degrees. course: "
      "form "
      "(i),\nslip and current ignored; E5: the thesis's best; bound: the same of errors drawn from the Cramer-Rao "
      "bound; ratio: root-mean-square\nerror of A..E over the bound's; 2 sigma: share of A..E within two stated "
      "standard errors (the priors hold one injected value).\n\n",
      options.runs);
  fmt::print(
      "| run | | thesis course | ours | thesis E5 | ours | bound | ratio | 2 sigma |\n|-|-|-|-|-|-|-|-|-|\n");
  std::array<double, 3> covered{};
  for (const Row& row : kRows) {
    const auto path = load_true_path(row.path);
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
      const bool noisy = c > 0;
      const Result result = measure_row(path, kColumns[c], noisy ? options.runs : 1);
      covered[c] += result.covered / kRows.size();
      fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} |\n", row.path, kColumns[c].name,
                 row.thesis[2 * c], result.course, row.thesis[2 * c + 1], result.ours,
                 noisy
                     ? fmt::format("{:.2f} | {:.2f} | {:.1f} %", result.bound, result.ratio, 100 * result.covered)
                     : "| | ");
      std::fflush(stdout);
    }
  }
  fmt::print("\nWithin two standard errors, all paths together: b {:.1f} %, c {:.1f} %.\n", 100 * covered[1],
             100 * covered[2]);
}

}  // namespace navcal::bench

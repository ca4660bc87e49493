// SPDX-License-Identifier: Apache-2.0
#include "report/calibrate_figures.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "calib/coverage.h"
#include "report/calibrate_words.h"
#include "report/svg_plot.h"
#include "report/svg_rose.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;

constexpr std::size_t kMostDots = 1500;
/// Standard error above which a curve is not drawn.
constexpr double kWorstCurve_rad = 0.3;
const SvgPlot::Axis kHeadingAxis{"heading of the compass, degrees", {0, 360}, 45};

/// Every n-th reading, so that at most kMostDots remain.
std::size_t stride_for(std::size_t count) { return count / kMostDots + 1; }

std::vector<Point> over_heading(const std::vector<analysis::HeadingResidual>& residuals,
                                double analysis::HeadingResidual::*which) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < residuals.size(); i += stride_for(residuals.size()))
    points.push_back(
        {residuals[i].heading_rad * base::kDegreesPerRadian, residuals[i].*which * base::kDegreesPerRadian});
  return points;
}

/// Standard error of the deviation at a heading, from the whole covariance of B..E.
double deviation_std_rad(const calib::CalibratorReport& compass, double heading_rad) {
  const Eigen::Vector4d f(std::sin(heading_rad), std::cos(heading_rad), std::sin(2 * heading_rad),
                          std::cos(2 * heading_rad));
  if (compass.covariance.rows() != 4) return NAN;
  return std::sqrt(f.dot(compass.covariance * f));
}

/// Heading that the compass shows less the magnetic one.
double deviation_rad(const calib::Report& report, double heading_rad) {
  return std::remainder(heading_rad - (*report.estimates.compass)(heading_rad), 2 * std::numbers::pi);
}

}  // namespace

std::vector<std::vector<std::string>> deviation_card(const calib::Report& report) {
  std::vector<std::vector<std::string>> rows;
  const auto* const compass = report.find(calib::Calibrator::compass);
  if (compass == nullptr || !compass->judgement.accepted || !report.estimates.compass) return rows;
  for (int degrees = 0; degrees < 360; degrees += 30) {
    const double shown_rad = degrees / base::kDegreesPerRadian, by_rad = deviation_rad(report, shown_rad);
    rows.push_back({fmt::format("{:03}", degrees), fmt::format("{:+.1f}", by_rad * base::kDegreesPerRadian),
                    fmt::format("{:.1f}", 2 * deviation_std_rad(*compass, shown_rad) * base::kDegreesPerRadian),
                    fmt::format("{:05.1f}", base::as_heading(shown_rad - by_rad) * base::kDegreesPerRadian)});
  }
  return rows;
}

std::optional<Figure> deviation_figure(const calib::Report& report,
                                       const std::vector<analysis::HeadingResidual>& residuals) {
  const auto* const compass = report.find(calib::Calibrator::compass);
  if (compass == nullptr || !report.estimates.compass) return std::nullopt;
  std::vector<Point> curve, lower, upper;
  for (int degrees = 0; degrees <= 360; degrees += 4) {
    const double heading_rad = degrees / base::kDegreesPerRadian;
    const double by_rad = deviation_rad(report, heading_rad);
    const double band_rad = 2 * deviation_std_rad(*compass, heading_rad);
    if (!(band_rad < kWorstCurve_rad)) return std::nullopt;
    curve.push_back({double(degrees), by_rad * base::kDegreesPerRadian});
    lower.push_back({double(degrees), (by_rad - band_rad) * base::kDegreesPerRadian});
    upper.push_back({double(degrees), (by_rad + band_rad) * base::kDegreesPerRadian});
  }
  const auto measured = over_heading(residuals, &analysis::HeadingResidual::deviation_rad);
  SvgPlot plot("Deviation of the compass", kHeadingAxis,
               {"deviation, degrees", range_of(coordinates(&Point::y, curve, measured))});
  plot.level(0);
  plot.points(Ink::before, "measured against the gyro", measured);
  plot.band(Ink::after, "two standard errors", lower, upper);
  plot.line(Ink::fit, "fitted", curve);
  return Figure{"Deviation", plot.svg(),
                "Measured heading less true heading, without A, which no turn reveals. Each block of turning is "
                "aligned with the curve by its mean, since the gyro does not measure north."};
}

std::optional<Figure> residual_figure(const calib::Report& report,
                                      const std::vector<analysis::HeadingResidual>& residuals) {
  if (residuals.empty()) return std::nullopt;
  const auto before = over_heading(residuals, &analysis::HeadingResidual::before_rad);
  const auto after = over_heading(residuals, &analysis::HeadingResidual::after_rad);
  SvgPlot plot("Heading against the gyro", kHeadingAxis,
               {"residual, degrees", range_of(coordinates(&Point::y, before, after))});
  plot.level(0);
  plot.points(Ink::before, "as measured", before);
  plot.points(Ink::after, "calibrated", after);
  std::string caption = fmt::format(
      "Heading less the integrated gyro, by blocks of turning. Root-mean-square {:.2f} degrees, calibrated "
      "{:.2f}. These readings were used for the estimates; those of the figures above were not.",
      analysis::root_mean_square(residuals, &analysis::HeadingResidual::before_rad) * base::kDegreesPerRadian,
      analysis::root_mean_square(residuals, &analysis::HeadingResidual::after_rad) * base::kDegreesPerRadian);
  const auto accepted = accepted_estimates(report);
  if (!accepted.magnetometer && !accepted.compass) caption += " No calibration of the heading was accepted.";
  return Figure{"Residual", plot.svg(), caption};
}

Figure rose_figure(const calib::Report& report) {
  const std::string missing = calib::missing_turn(report.rose);
  return {"Headings seen", svg_rose(report.rose),
          fmt::format("{} of {} sectors of ten degrees{}{}. The area is the number of readings.",
                      calib::visited(report.rose), report.rose.size(), missing.empty() ? "" : "; ", missing)};
}

}  // namespace navcal::report

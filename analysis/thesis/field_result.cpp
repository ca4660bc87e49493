// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/thesis/thesis_parts.h"
#include "base/angles.h"
#include "base/statistics.h"
#include "calib/thesis/distorted_field.h"
#include "calib/thesis/printed_tables.h"

namespace navcal::analysis {

namespace thesis = calib::thesis;

namespace {

using FieldPoints = std::vector<Eigen::Vector2d>;

calib::EllipseShape circle_of(std::size_t row) {
  const thesis::PrintedCircle& printed = thesis::kTable4_2.at(row);
  return thesis::distorted_circle(
      {{printed.shift_x_uT, printed.shift_y_uT}, printed.eccentricity, printed.axis_deg});
}

/// The headings of the thesis's circles as a path.
ThesisPath circle_path() {
  ThesisPath path(thesis::kCirclePoints);
  for (std::size_t k = 0; k < path.size(); ++k) path[k].heading_rad = 0.01 * static_cast<double>(k);
  return path;
}

FieldPoints field_along(const ThesisPath& path, const calib::EllipseShape& field, double noise_uT,
                        thesis::Random& random) {
  std::normal_distribution<double> normal;
  FieldPoints points;
  points.reserve(path.size());
  for (const thesis::TruePoint& point : path) {
    const double x = noise_uT * normal(random), y = noise_uT * normal(random);
    points.emplace_back(field.at(point.heading_rad) + Eigen::Vector2d(x, y));
  }
  return points;
}

/// Method of the thesis (4.12 to 4.18); identity where it gives nothing.
calib::FieldCorrection thesis_correction(const FieldPoints& points) {
  calib::FieldCorrection correction;
  if (const auto moments = thesis::CircleMoments::fit(points)) {
    correction.offset_uT.head<2>() = moments->centre_uT;
    correction.matrix.topLeftCorner<2, 2>() = moments->matrix;
  }
  return correction;
}

/// Our ellipse by maximum likelihood; identity where it gives nothing.
calib::FieldCorrection navcal_correction(const FieldPoints& points) {
  calib::EllipseEstimator ellipse(thesis::ellipse_parameters());
  for (const auto& point : points) ellipse.update({point.x(), point.y(), 0}, 0, 0);
  ellipse.settle();
  const auto estimate = ellipse.estimate();
  return estimate ? estimate->correction : calib::FieldCorrection{};
}

/// True less measured, as on the axes of figures 4.8 to 4.12.
double sample_error_deg(const calib::FieldCorrection& correction, const Eigen::Vector2d& field_uT,
                        double heading_rad) {
  const Eigen::Vector3d corrected = correction({field_uT.x(), field_uT.y(), 0});
  return base::wrapped(heading_rad - calib::levelled_heading(corrected, 0, 0)) * base::kDegreesPerRadian;
}

/// What one set of samples of a circle gives.
struct CircleRun {
  double least_raw_deg = 0, largest_raw_deg = 0, residual_deg = 0;
  thesis::HeadingError by_moments, by_ellipse;
};

CircleRun circle_run(const ThesisPath& path, const calib::EllipseShape& field, const FieldPoints& points) {
  CircleRun run;
  const calib::FieldCorrection by_moments = thesis_correction(points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double raw = sample_error_deg({}, points[k], path[k].heading_rad);
    run.least_raw_deg = std::min(run.least_raw_deg, raw);
    run.largest_raw_deg = std::max(run.largest_raw_deg, raw);
    run.residual_deg =
        std::max(run.residual_deg, std::abs(sample_error_deg(by_moments, points[k], path[k].heading_rad)));
  }
  run.by_moments = thesis::heading_error(by_moments, field);
  run.by_ellipse = thesis::heading_error(navcal_correction(points), field);
  return run;
}

template <class Get>
double median_of(const std::vector<CircleRun>& runs, Get get) {
  std::vector<double> values(runs.size());
  std::ranges::transform(runs, values.begin(), get);
  return base::median(std::move(values));
}

}  // namespace

ThesisCircle thesis_circle_result(std::size_t row, int runs, std::uint64_t seed) {
  const calib::EllipseShape field = circle_of(row);
  const ThesisPath path = circle_path();
  thesis::Random random(seed);
  std::vector<CircleRun> noisy;
  for (int i = 0; i < runs; ++i)
    noisy.push_back(circle_run(path, field, field_along(path, field, thesis::Noise{}.field_uT, random)));
  std::vector<CircleRun> shown = noisy;
  if (!thesis::kTable4_2.at(row).noise) shown = {circle_run(path, field, field_along(path, field, 0, random))};
  ThesisCircle result{};
  result.raw_deg = {median_of(shown, [](const CircleRun& r) { return r.least_raw_deg; }),
                    median_of(shown, [](const CircleRun& r) { return r.largest_raw_deg; })};
  result.residual_deg = median_of(shown, [](const CircleRun& r) { return r.residual_deg; });
  result.thesis_deg = median_of(shown, [](const CircleRun& r) { return r.by_moments.largest_deg; });
  result.navcal_deg = median_of(shown, [](const CircleRun& r) { return r.by_ellipse.largest_deg; });
  for (const CircleRun& run : noisy) {
    result.thesis_rms_deg += run.by_moments.rms_deg * run.by_moments.rms_deg / runs;
    result.navcal_rms_deg += run.by_ellipse.rms_deg * run.by_ellipse.rms_deg / runs;
  }
  result.thesis_rms_deg = std::sqrt(result.thesis_rms_deg);
  result.navcal_rms_deg = std::sqrt(result.navcal_rms_deg);
  result.bound_deg = thesis::ellipse_bound_deg(path, field);
  return result;
}

ThesisFieldPath thesis_field_path(const ThesisPath& path, const calib::EllipseShape& field, int runs,
                                  std::uint64_t seed) {
  thesis::Random random(seed);
  ThesisFieldPath result{};
  result.thesis_deg =
      thesis::heading_error(thesis_correction(field_along(path, field, 0, random)), field).largest_deg;
  std::vector<double> by_moments, by_ellipse;
  for (int i = 0; i < runs; ++i) {
    const FieldPoints points = field_along(path, field, thesis::Noise{}.field_uT, random);
    by_moments.push_back(thesis::heading_error(thesis_correction(points), field).largest_deg);
    const thesis::HeadingError ours = thesis::heading_error(navcal_correction(points), field);
    by_ellipse.push_back(ours.largest_deg);
    result.navcal_rms_deg += ours.rms_deg * ours.rms_deg / runs;
  }
  result.thesis_noisy_deg = base::median(std::move(by_moments));
  result.navcal_noisy_deg = base::median(std::move(by_ellipse));
  result.navcal_rms_deg = std::sqrt(result.navcal_rms_deg);
  result.bound_deg = thesis::ellipse_bound_deg(path, field);
  return result;
}

ThesisCircleTrace thesis_circle_trace(std::size_t row, std::uint64_t seed) {
  const calib::EllipseShape field = circle_of(row);
  const ThesisPath path = circle_path();
  thesis::Random random(seed);
  const FieldPoints points =
      field_along(path, field, thesis::kTable4_2.at(row).noise ? thesis::Noise{}.field_uT : 0, random);
  const calib::FieldCorrection by_moments = thesis_correction(points), by_ellipse = navcal_correction(points);
  ThesisCircleTrace trace;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double heading_rad = path[k].heading_rad;
    trace.heading_deg.push_back(heading_rad * base::kDegreesPerRadian);
    trace.raw_x_uT.push_back(points[k].x());
    trace.raw_y_uT.push_back(points[k].y());
    const Eigen::Vector3d corrected = by_moments({points[k].x(), points[k].y(), 0});
    trace.thesis_x_uT.push_back(corrected.x());
    trace.thesis_y_uT.push_back(corrected.y());
    trace.raw_error_deg.push_back(sample_error_deg({}, points[k], heading_rad));
    trace.thesis_error_deg.push_back(sample_error_deg(by_moments, points[k], heading_rad));
    trace.navcal_error_deg.push_back(sample_error_deg(by_ellipse, points[k], heading_rad));
  }
  return trace;
}

}  // namespace navcal::analysis

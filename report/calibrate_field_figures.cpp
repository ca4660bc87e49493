// SPDX-License-Identifier: Apache-2.0
// Figures of the magnetometer, before and after calibration.
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/magnetometer/ellipse_shape.h"
#include "report/calibrate_figures.h"
#include "report/calibrate_words.h"
#include "report/plot_axes.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;

constexpr std::size_t kMostFieldDots = 1500;
constexpr double kSide = 460;
constexpr std::array<const char*, 3> kAxisTitles{"forward, uT", "starboard, uT", "down, uT"};

/// Tilt above which the vertical field affects the horizontal axes as much as the heading does.
constexpr double kLevel_rad = 15 * std::numbers::pi / 180;
/// Share of steeper readings up to which headings are marked.
constexpr double kMostSteep = 0.1;

/// Readings of the field, levelled if a horizontal ellipse was fitted.
struct Fields {
  std::vector<double> time_s;
  std::vector<Eigen::Vector3d> before, after;
  std::size_t steep = 0;  ///< readings with more roll or pitch than kLevel_rad, or of unknown tilt
};

Eigen::Vector3d levelled3(const Eigen::Vector3d& field_uT, const calib::CompassReading& reading) {
  const Eigen::Vector2d level = calib::levelled(field_uT, *reading.roll_rad, *reading.pitch_rad);
  return {level.x(), level.y(), 0};
}

Fields fields_of(const std::vector<analysis::TurnedSample>& samples,
                 const std::optional<calib::FieldCorrection>& correction, bool level) {
  Fields fields;
  for (const analysis::TurnedSample& sample : samples) {
    const auto& reading = sample.reading;
    if (!reading.field_body_uT || (level && (!reading.roll_rad || !reading.pitch_rad))) continue;
    const auto placed = [&](const Eigen::Vector3d& field) { return level ? levelled3(field, reading) : field; };
    const bool flat =
        level || (reading.roll_rad && reading.pitch_rad && std::abs(*reading.roll_rad) < kLevel_rad &&
                  std::abs(*reading.pitch_rad) < kLevel_rad);
    if (!flat) ++fields.steep;
    fields.time_s.push_back(reading.time_s);
    fields.before.push_back(placed(*reading.field_body_uT));
    if (correction) fields.after.push_back(placed((*correction)(*reading.field_body_uT)));
  }
  return fields;
}

/// Components `across` and `up` of every n-th reading.
std::vector<Point> projected(const std::vector<Eigen::Vector3d>& fields, int across, int up) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < fields.size(); i += fields.size() / kMostFieldDots + 1) {
    points.push_back({fields[i][across], fields[i][up]});
  }
  return points;
}

/// Outline of {m: |matrix (m - offset)| = size}, seen along the axis that is neither `across` nor `up`: the part
/// of the ellipsoid's inverse form in those two axes.
std::vector<Point> outline(const calib::FieldCorrection& correction, double size_uT, int across, int up) {
  const Eigen::Matrix3d inverse = correction.matrix.inverse() * size_uT;
  const Eigen::Matrix3d form = inverse * inverse.transpose();
  Eigen::Matrix2d part;
  part << form(across, across), form(across, up), form(up, across), form(up, up);
  const Eigen::Matrix2d root = part.llt().matrixL();
  std::vector<Point> points;
  for (int degrees = 0; degrees <= 360; degrees += 4) {
    const double angle = degrees * std::numbers::pi / 180;
    const Eigen::Vector2d place = root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    points.push_back({correction.offset_uT[across] + place.x(), correction.offset_uT[up] + place.y()});
  }
  return points;
}

SvgPlot square_plot(std::string_view title, int across, int up, const std::vector<Point>& points,
                    const std::vector<Point>& line) {
  // Readings may have outliers; the outline has none.
  const auto range = [&](double Point::*axis) {
    const Range a = range_of(coordinates(axis, kZero, points)), b = whole_range_of(coordinates(axis, kZero, line));
    return Range{std::min(a.least, b.least), std::max(a.most, b.most)};
  };
  Range rx = range(&Point::x), ry = range(&Point::y);
  make_equally_long(rx, ry);
  const double height = kSide - SvgPlot::kLeft - SvgPlot::kRight + SvgPlot::kTop + SvgPlot::kBottom;
  return {title,
          {kAxisTitles[static_cast<std::size_t>(across)], rx},
          {kAxisTitles[static_cast<std::size_t>(up)], ry},
          {kSide, height}};
}

/// Direction of the bow: with the bow to the east, north is to port. The marks lie just within the circle of the
/// points, which are seen from above, starboard across and forward up.
void mark_headings(SvgPlot& plot, const std::vector<Point>& points) {
  if (points.empty()) return;
  double radius = 0;
  for (const Point& point : points) radius += std::hypot(point.x, point.y) / static_cast<double>(points.size());
  radius *= 0.75;
  plot.word({0, radius}, "N");
  plot.word({-radius, 0}, "E");
  plot.word({0, -radius}, "S");
  plot.word({radius, 0}, "W");
}

double spread_percent(const std::vector<Eigen::Vector3d>& fields) {
  double mean = 0, squares = 0, count = 0;
  for (const auto& field : fields) {
    const double departure = field.norm() - mean;
    mean += departure / ++count;
    squares += departure * (field.norm() - mean);
  }
  return count > 1 && mean > 0 ? 100 * std::sqrt(squares / (count - 1)) / mean : 0;
}

Figure size_figure(const Fields& fields, bool level) {
  const TimeAxis time(fields.time_s);
  std::vector<Point> before, after;
  for (std::size_t i = 0; i < fields.before.size(); i += fields.before.size() / kMostFieldDots + 1) {
    before.push_back({time(fields.time_s[i]), fields.before[i].norm()});
    if (!fields.after.empty()) after.push_back({time(fields.time_s[i]), fields.after[i].norm()});
  }
  SvgPlot plot("Size of the field", time.axis(), {"uT", range_of(coordinates(&Point::y, before, after))});
  plot.points(Ink::before, "measured", before);
  plot.points(Ink::after, "calibrated", after);
  std::string caption = fmt::format("{} field. Spread, its standard deviation over its mean: {:.2f} % as measured",
                                    level ? "Horizontal" : "Whole", spread_percent(fields.before));
  if (!fields.after.empty()) caption += fmt::format(", {:.2f} % calibrated", spread_percent(fields.after));
  return {"Size of the field", plot.svg(), caption + "."};
}

}  // namespace

std::vector<Figure> field_figures(const calib::Report& report,
                                  const std::vector<analysis::TurnedSample>& samples) {
  const auto* const magnetometer = report.find(calib::Calibrator::magnetometer);
  if (magnetometer == nullptr) return {};
  const auto& correction = report.estimates.magnetometer;
  const auto* const vertical = magnetometer->quantity("offset_z_uT");
  const auto* const size = magnetometer->quantity("field_uT");
  const bool level = vertical == nullptr || !std::isfinite(vertical->std);
  const Fields fields = fields_of(samples, correction, level);
  if (fields.before.empty()) return {};

  std::string field_text;
  for (const ShownQuantity& quantity : shown(*magnetometer)) {
    if (quantity.name == "field") field_text = text_of(quantity, "\u00b1");
  }
  std::vector<Figure> figures;
  const std::string seen = level ? "levelled by pitch and roll" : "in the axes of the vehicle";
  const auto add_view = [&](int across, int up, const std::string& from) {
    const auto before = projected(fields.before, across, up);
    const auto fitted =
        correction && size != nullptr ? outline(*correction, size->value, across, up) : std::vector<Point>{};
    SvgPlot raw = square_plot("Field as measured", across, up, before, fitted);
    raw.points(Ink::before, "measured", before);
    raw.line(Ink::fit, level ? "fitted ellipse" : "outline of the fitted ellipsoid", fitted);
    figures.push_back({"Field as measured, " + from, raw.svg(), "Readings " + seen + "."});
    if (!correction || size == nullptr) return;
    const auto after = projected(fields.after, across, up);
    const auto circle = outline({}, size->value, across, up);
    SvgPlot calibrated = square_plot("Field calibrated", across, up, after, circle);
    calibrated.points(Ink::after, "calibrated", after);
    calibrated.line(Ink::fit, level ? "horizontal field" : "outline of the sphere", circle);
    const bool flat = static_cast<double>(fields.steep) <= kMostSteep * static_cast<double>(fields.before.size());
    const bool marked = across == 1 && up == 0 && flat;
    if (marked) mark_headings(calibrated, after);
    figures.push_back({"Field calibrated, " + from, calibrated.svg(),
                       fmt::format("matrix * (measured - offset), {}; {}{}.{}", seen, level ? "horizontal " : "",
                                   field_text, marked ? " N, E, S, W: where the bow pointed." : "")});
  };
  add_view(1, 0, "from above");
  if (!level) add_view(0, 2, "from the side");
  figures.push_back(size_figure(fields, level));
  return figures;
}

}  // namespace navcal::report

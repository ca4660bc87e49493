// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/angles.h"
#include "calib/thesis/distorted_field.h"
#include "report/thesis_content.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;
using calib::EllipseShape;

constexpr const char* kTrueHeading = "true heading, degrees";
/// Level field of chapter 2.
constexpr double kLevelField_uT = 19;

struct LevelFieldFigure {
  const char *id, *title;
  calib::thesis::FieldDistortion distortion{};  ///< its sizes are those of a circle of kLevelField_uT
  double turned_deg = 0;                        ///< of the sensor in the vehicle, clockwise
};
const std::array<LevelFieldFigure, 4> kLevelFields{{{"2.3", "Level field without an error"},
                                                    {"2.4", "Level field of a compass that is misaligned", {}, 5},
                                                    {"2.5", "Level field with hard iron", {{4, 2.5}}},
                                                    {"2.6", "Level field with soft iron", {{0, 0}, 0.6, 30}}}};

EllipseShape level_field(const LevelFieldFigure& figure) {
  EllipseShape shape = calib::thesis::distorted_circle(figure.distortion);
  const double c = std::cos(figure.turned_deg * base::kRadiansPerDegree);
  const double s = std::sin(figure.turned_deg * base::kRadiansPerDegree);
  shape.axes_uT *= kLevelField_uT / calib::thesis::kCircle_uT;
  shape.axes_uT = Eigen::Matrix2d{{c, s}, {-s, c}} * shape.axes_uT;
  return shape;
}

/// One point for each degree of true heading, 0 to 360.
template <class Value>
ThesisCurve round_curve(const char* name, Ink ink, Value value) {
  ThesisCurve curve{name, ink, {}, {}};
  for (int heading_deg = 0; heading_deg <= 360; ++heading_deg) {
    curve.x.push_back(heading_deg);
    curve.y.push_back(value(heading_deg * base::kRadiansPerDegree));
  }
  return curve;
}

/// Measured less true heading, degrees.
ThesisCurve heading_error_curve(const char* name, const EllipseShape& shape) {
  return round_curve(name, Ink::second, [&](double heading_rad) {
    return calib::thesis::heading_error_rad({}, shape, heading_rad) * base::kDegreesPerRadian;
  });
}

ThesisFigure level_field_figure(const LevelFieldFigure& figure) {
  const EllipseShape shape = level_field(figure);
  ThesisPanel field{"Level field", "starboard, uT", "forward, uT", {{"", Ink::fit, {}, {}}}, true};
  constexpr std::array kInks{Ink::first, Ink::second, Ink::third, Ink::fourth};
  constexpr std::array kPoints{"N", "E", "S", "W"};
  for (int heading_deg = 0; heading_deg <= 360; heading_deg += 2) {
    const Eigen::Vector2d tip = shape.at(heading_deg * base::kRadiansPerDegree);
    field.curves[0].x.push_back(tip.y());
    field.curves[0].y.push_back(tip.x());
    if (const auto quarter = static_cast<std::size_t>(heading_deg / 90); heading_deg % 90 == 0 && quarter < 4)
      field.curves.push_back({kPoints.at(quarter), kInks.at(quarter), {tip.y()}, {tip.x()}, true});
  }
  return {figure.id,
          figure.title,
          {std::move(field),
           {"Error of the heading",
            kTrueHeading,
            "degrees",
            {heading_error_curve("", shape)},
            false,
            Range{-15, 15}}}};
}

/// Occurrences of each full second, as the outline of bars.
ThesisFigure first_fix_figure(const char* id, const analysis::ThesisFirstFixes& fixes) {
  ThesisCurve outline{"", Ink::first, {}, {}};
  for (int second = 0; second <= fixes.longest_s + 1; ++second) {
    const auto count = static_cast<double>(std::ranges::count(fixes.times_s, second));
    outline.x.insert(outline.x.end(), {second - 0.5, second + 0.5});
    outline.y.insert(outline.y.end(), {count, count});
  }
  return {
      id,
      fmt::format("Time to the first fix after {} minutes under water", fixes.under_s / 60),
      {{"First fixes", "seconds from surfacing", "occurrences", {std::move(outline)}}},
      fmt::format("On record are the bins of the thesis, 1 to {} s, with up to 5 occurrences, and not the single "
                  "times. Shown are {} surfacings of navcal's simulated receiver with a search of 0 to {} s.",
                  fixes.longest_s, fixes.times_s.size(), fixes.longest_s)};
}

}  // namespace

std::vector<ThesisFigure> thesis_model_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures{first_fix_figure("1.1", results.first_fixes[0]),
                                    first_fix_figure("1.2", results.first_fixes[1])};
  for (const LevelFieldFigure& figure : kLevelFields) figures.push_back(level_field_figure(figure));
  return figures;
}

ThesisFigure thesis_deviation_figure() {
  const calib::thesis::Deviation deviation = calib::thesis::thesis_deviation();
  return {
      "4.1",
      "Heading error of the simulated compass",
      {{"Error of the heading", kTrueHeading, "degrees", {round_curve("", Ink::second, [&](double heading_rad) {
          return -calib::thesis::deviation_rad(deviation, heading_rad) * base::kDegreesPerRadian;
        })}}}};
}

ThesisFigure thesis_hard_iron_figure() {
  const EllipseShape shape = level_field(kLevelFields[2]);
  return {"4.7",
          "Hard iron and its model",
          {{"Error of the heading",
            kTrueHeading,
            "degrees",
            {heading_error_curve("hard iron", shape), round_curve("model", Ink::first, [&](double heading_rad) {
               const Eigen::Vector2d tip = shape.at(heading_rad);
               return (shape.centre_uT.x() * tip.y() - shape.centre_uT.y() * tip.x()) / tip.norm() /
                      kLevelField_uT * base::kDegreesPerRadian;
             })}}}};
}

}  // namespace navcal::report

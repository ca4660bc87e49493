// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::report {

struct Point {
  double x = 0, y = 0;
};

struct Range {
  double least = 0, most = 1;
  [[nodiscard]] double length() const { return most - least; }
  [[nodiscard]] bool contains(double value) const { return value >= least && value <= most; }
};

/// One coordinate (&Point::x, &Point::y) of all points of these lists.
template <class... Lists>
[[nodiscard]] std::vector<double> coordinates(double Point::*axis, const Lists&... lists) {
  std::vector<double> values;
  const auto add = [&](std::span<const Point> points) {
    for (const Point& point : points) values.push_back(point.*axis);
  };
  (add(lists), ...);
  return values;
}
/// The point zero, a list beside others whose range shall include it.
inline constexpr std::array<Point, 1> kZero{};

/// Range of all finite values except outliers and the outermost few in a thousand on either side; with a margin;
/// never empty.
[[nodiscard]] Range range_of(std::vector<double> values);
/// Range of all finite values, outliers included; with a margin; never empty.
[[nodiscard]] Range whole_range_of(const std::vector<double>& values);
/// Both ranges about their middles, as long as the longer one and at least that long, so that a metre north is as
/// long as a metre east.
void make_equally_long(Range& x, Range& y, double least_length = 0);
/// About that many round values within a range, 1, 2 or 5 apart in their leading digit.
[[nodiscard]] std::vector<double> round_values(Range range, int about);

/// A diagram as SVG within a page. Colours come from the page's style by class (html_page.cpp), so that one
/// diagram serves light, dark and print. No Debian or npm package draws for C++ without a JavaScript library in
/// every page.
class SvgPlot {
 public:
  struct Tick {
    double value = 0;
    std::string text;
  };
  struct Axis {
    std::string label;
    Range range;
    double step = 0;            ///< between ticks; 0: chosen round values
    std::vector<Tick> ticks{};  ///< instead of numbers
  };
  /// Colours of the page.
  enum class Ink { before, after, fit, first, second, third, fourth };
  struct Size {
    double width = 560, height = 320;
  };
  static constexpr double kLeft = 58, kRight = 14, kTop = 30, kBottom = 42;

  SvgPlot(std::string_view title, Axis x, Axis y, Size size);
  SvgPlot(std::string_view title, Axis x, Axis y) : SvgPlot(title, std::move(x), std::move(y), Size()) {}

  // Elements are drawn in the order of the calls, the first lowest. A name enters the legend once; an empty one
  // does not. Points that are not finite are left out and end a line. Content outside the axes is clipped: a
  // triangle at the edge marks the place, and a line of text gives the number. Bands are clipped without a mark.
  void band(Ink ink, std::string_view name, std::span<const Point> lower, std::span<const Point> upper);
  void points(Ink ink, std::string_view name, std::span<const Point> points);
  void line(Ink ink, std::string_view name, std::span<const Point> points);
  /// A thin horizontal line.
  void level(double y);
  /// A word at a point.
  void word(const Point& at, std::string_view text);

  [[nodiscard]] std::string svg() const;

 private:
  enum class Mark { dot, stroke, area };

  [[nodiscard]] double x_of(double x) const;
  [[nodiscard]] double y_of(double y) const;
  [[nodiscard]] bool visible(const Point& point) const;
  void append_path(std::string& path, std::span<const Point> points, bool& begun) const;
  void append_axes(std::string& out) const;
  void legend(Ink ink, Mark mark, std::string_view name);
  void mark_cut(const Point& point);
  void append_cuts(std::string& out) const;
  [[nodiscard]] bool any_cut() const;

  static constexpr double kCutWords = 16;  ///< height of the line with the number of clipped points
  static constexpr int kCutMark_px = 6;    ///< width of a triangle, so that triangles do not overlap

  std::string title_;
  Axis x_, y_;
  Size size_;
  std::string body_, legend_;
  double legend_x_ = kLeft;
  enum Side { above, below, left, right };
  struct Cut {
    std::set<int> at_px;  ///< position along the edge
    std::size_t points = 0;
  };
  std::array<Cut, 4> cuts_;  ///< one for each side
};

}  // namespace navcal::report

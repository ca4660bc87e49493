// SPDX-License-Identifier: Apache-2.0
#include "report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/append_format.h"
#include "report/html_page.h"

namespace navcal::report {
namespace {

constexpr double kLetterWidth = 6.3;  // mean width in the legend's type
constexpr std::array<std::string_view, 7> kNamesOfInks{"before", "after", "fit",   "first",
                                                       "second", "third", "fourth"};

std::string_view name_of(SvgPlot::Ink ink) { return kNamesOfInks[static_cast<std::size_t>(ink)]; }

/// Label of a tick, with only the digits that the distance between ticks needs.
std::string tick_text(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
  std::string text = fmt::format("{:.{}f}", std::abs(value) < step * 1e-6 ? 0.0 : value, decimals);
  if (text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

double round_step(double length, int about) {
  const double rough = length / std::max(about, 1);
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= rough * 0.999) return digit * power;
  }
  return 10 * power;
}

std::vector<double> multiples(Range range, double step) {
  std::vector<double> values;
  const double first = std::ceil(range.least / step - 1e-9);
  for (double i = first; i * step <= range.most + 1e-9 * step; ++i) values.push_back(i * step);
  return values;
}

}  // namespace

namespace {

/// The given ticks, or numbers at round values.
std::vector<SvgPlot::Tick> ticks_of(const SvgPlot::Axis& axis, int about) {
  if (!axis.ticks.empty()) return axis.ticks;
  const auto values = axis.step > 0 ? multiples(axis.range, axis.step) : round_values(axis.range, about);
  const double step = values.size() > 1 ? values[1] - values[0] : 1.0;
  std::vector<SvgPlot::Tick> ticks;
  for (const double value : values) ticks.push_back({value, tick_text(value, step)});
  return ticks;
}

/// A value further from the inner range than this many of its lengths is an outlier.
constexpr double kJump = 2;
/// An axis is at most this many times as long as the range of the middle four fifths of the values.
constexpr double kLongest = 40;

/// Range of sorted values without outliers. It grows outwards from the middle four fifths, and ends before a value
/// that would lengthen it by a jump.
Range without_outliers(const std::vector<double>& sorted) {
  const std::size_t n = sorted.size(), few = n / 300;
  std::size_t low = n / 10, high = n - 1 - n / 10;
  const double middle = sorted[high] - sorted[low];
  // If most values are equal, any other would be a jump.
  if (!(middle > 0)) return {sorted[few], sorted[n - 1 - few]};
  const double most = kLongest * middle;
  while (low > few && sorted[high] - sorted[low - 1] <= std::min(most, (1 + kJump) * (sorted[high] - sorted[low])))
    --low;
  while (high + 1 < n - few &&
         sorted[high + 1] - sorted[low] <= std::min(most, (1 + kJump) * (sorted[high] - sorted[low]))) {
    ++high;
  }
  return {sorted[low], sorted[high]};
}

Range with_margin(Range range) {
  // Constant values get one tick, not ticks that differ in the seventh digit.
  const double size = std::abs(range.least);
  const bool constant = range.length() <= 1e-6 * size;
  const double margin = constant ? (size > 0 ? 0.01 * size : 1) : 0.06 * range.length();
  return {range.least - margin, range.most + margin};
}

}  // namespace

Range range_of(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }),
               values.end());
  if (values.empty()) return {-1, 1};
  std::ranges::sort(values);
  return with_margin(without_outliers(values));
}

Range whole_range_of(const std::vector<double>& values) {
  Range range{INFINITY, -INFINITY};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range = {std::min(range.least, value), std::max(range.most, value)};
  }
  return range.length() >= 0 ? with_margin(range) : Range{-1, 1};
}

void make_equally_long(Range& x, Range& y, double least_length) {
  const double half = std::max({x.length(), y.length(), least_length}) / 2;
  for (Range* range : {&x, &y}) {
    const double middle = (range->least + range->most) / 2;
    *range = {middle - half, middle + half};
  }
}

std::vector<double> round_values(Range range, int about) {
  if (!(range.length() > 0) || !std::isfinite(range.length())) return {};
  return multiples(range, round_step(range.length(), about));
}

SvgPlot::SvgPlot(std::string_view title, Axis x, Axis y, Size size)
    : title_(escaped(title)), x_(std::move(x)), y_(std::move(y)), size_(size) {}

double SvgPlot::x_of(double x) const {
  return (x - x_.range.least) / x_.range.length() * (size_.width - kLeft - kRight);
}

double SvgPlot::y_of(double y) const {
  return (y_.range.most - y) / y_.range.length() * (size_.height - kTop - kBottom);
}

bool SvgPlot::visible(const Point& point) const {
  return x_.range.contains(point.x) && y_.range.contains(point.y);
}

/// Points far outside are moved to just outside, so that they do not overflow a browser's numbers.
void SvgPlot::append_path(std::string& path, std::span<const Point> points, bool& begun) const {
  for (const Point& point : points) {
    const double x = x_of(point.x), y = y_of(point.y);
    if (!std::isfinite(x) || !std::isfinite(y)) {
      begun = false;
      continue;
    }
    base::append_format(path, "{}{:.1f} {:.1f}", begun ? 'L' : 'M', std::clamp(x, -9999.0, 9999.0),
                        std::clamp(y, -9999.0, 9999.0));
    begun = true;
  }
}

void SvgPlot::band(Ink ink, std::string_view name, std::span<const Point> lower, std::span<const Point> upper) {
  std::vector<Point> around(lower.begin(), lower.end());
  around.insert(around.end(), upper.rbegin(), upper.rend());
  around.erase(std::remove_if(around.begin(), around.end(),
                              [](const Point& p) { return !std::isfinite(p.x) || !std::isfinite(p.y); }),
               around.end());
  if (around.empty()) return;
  std::string path;
  bool begun = false;
  append_path(path, around, begun);
  base::append_format(body_, "<path class=\"area {}\" d=\"{}Z\"/>\n", name_of(ink), path);
  legend(ink, Mark::area, name);
}

void SvgPlot::points(Ink ink, std::string_view name, std::span<const Point> points) {
  std::string path;
  for (const Point& point : points) {
    mark_cut(point);
    // A line of zero length with round ends is a dot, in a third of the bytes of a circle.
    if (visible(point)) base::append_format(path, "M{:.1f} {:.1f}h0", x_of(point.x), y_of(point.y));
  }
  if (path.empty()) return;
  base::append_format(body_, "<path class=\"dots {}\" d=\"{}\"/>\n", name_of(ink), path);
  legend(ink, Mark::dot, name);
}

void SvgPlot::line(Ink ink, std::string_view name, std::span<const Point> points) {
  for (const Point& point : points) mark_cut(point);
  std::string path;
  bool begun = false;
  append_path(path, points, begun);
  if (path.empty()) return;
  base::append_format(body_, "<path class=\"line {}\" d=\"{}\"/>\n", name_of(ink), path);
  legend(ink, Mark::stroke, name);
}

void SvgPlot::mark_cut(const Point& point) {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || visible(point)) return;
  const bool to_the_side = !x_.range.contains(point.x);
  Cut& cut = cuts_.at(to_the_side ? (point.x < x_.range.least ? left : right)
                                  : (point.y > y_.range.most ? above : below));
  ++cut.points;
  const double along = to_the_side ? y_of(std::clamp(point.y, y_.range.least, y_.range.most)) : x_of(point.x);
  cut.at_px.insert(static_cast<int>(along) / kCutMark_px * kCutMark_px);
}

void SvgPlot::append_cuts(std::string& out) const {
  constexpr std::array<std::string_view, 4> kSides{"above", "below", "left", "right"};
  std::string words;
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    if (cuts_[i].points > 0)
      base::append_format(words, "{}{} {}", words.empty() ? "" : ", ", cuts_[i].points, kSides[i]);
  }
  if (words.empty()) return;
  const double width = size_.width - kLeft - kRight, height = size_.height - kTop - kBottom;
  std::string path;
  for (const int x : cuts_[above].at_px)
    base::append_format(path, "M{:.1f} {:.1f}l3 -5l3 5Z", kLeft + x, kTop + 6);
  for (const int x : cuts_[below].at_px)
    base::append_format(path, "M{:.1f} {:.1f}l3 5l3 -5Z", kLeft + x, kTop + height - 6);
  for (const int y : cuts_[left].at_px) base::append_format(path, "M{:.1f} {:.1f}l-5 3l5 3Z", kLeft + 6, kTop + y);
  for (const int y : cuts_[right].at_px)
    base::append_format(path, "M{:.1f} {:.1f}l5 3l-5 3Z", kLeft + width - 6, kTop + y);
  base::append_format(out, "<path class=\"cut\" d=\"{}\"/>\n", path);
  base::append_format(
      out, "<text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">beyond the axes: {}</text>\n",
      kLeft + width, size_.height + kCutWords - 6, words);
}

bool SvgPlot::any_cut() const {
  return std::ranges::any_of(cuts_, [](const Cut& cut) { return cut.points > 0; });
}

void SvgPlot::level(double y) {
  if (!y_.range.contains(y)) return;
  base::append_format(body_, "<path class=\"grid strong\" d=\"M0 {:.1f}h{:.1f}\"/>\n", y_of(y),
                      size_.width - kLeft - kRight);
}

void SvgPlot::word(const Point& at, std::string_view text) {
  if (!visible(at)) return;
  base::append_format(body_,
                      "<text class=\"tick halo\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                      x_of(at.x), y_of(at.y) + 4, escaped(text));
}

void SvgPlot::legend(Ink ink, Mark mark, std::string_view name) {
  if (name.empty()) return;
  switch (mark) {
    case Mark::dot:
      base::append_format(legend_, "<path class=\"dots {}\" style=\"stroke-width:6\" d=\"M{:.0f} 14h0\"/>",
                          name_of(ink), legend_x_ + 8);
      break;
    case Mark::stroke:
      base::append_format(legend_, "<path class=\"line {}\" d=\"M{:.0f} 14h16\"/>", name_of(ink), legend_x_);
      break;
    case Mark::area:
      base::append_format(legend_, "<path class=\"area {}\" d=\"M{:.0f} 9h16v10h-16Z\"/>", name_of(ink),
                          legend_x_);
      break;
  }
  base::append_format(legend_, "<text x=\"{:.0f}\" y=\"18\">{}</text>\n", legend_x_ + 21, escaped(name));
  legend_x_ += 36 + kLetterWidth * static_cast<double>(name.size());
}

void SvgPlot::append_axes(std::string& out) const {
  const double width = size_.width - kLeft - kRight, height = size_.height - kTop - kBottom;
  std::string grid, text;
  for (const auto& [value, words] : ticks_of(x_, 8)) {
    const double x = kLeft + x_of(value);
    base::append_format(grid, "M{:.1f} {:.1f}v{:.1f}", x, kTop, height);
    base::append_format(text, "<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                        x, kTop + height + 15, escaped(words));
  }
  for (const auto& [value, words] : ticks_of(y_, 6)) {
    const double y = kTop + y_of(value);
    base::append_format(grid, "M{:.1f} {:.1f}h{:.1f}", kLeft, y, width);
    base::append_format(text, "<text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                        kLeft - 6, y + 4, escaped(words));
  }
  base::append_format(out, "<path class=\"grid\" d=\"{}\"/>\n{}", grid, text);
  base::append_format(out, "<text text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kLeft + width / 2,
                      size_.height - 7, escaped(x_.label));
  base::append_format(out,
                      "<text text-anchor=\"middle\" transform=\"translate(13 {:.1f}) rotate(-90)\">{}</text>\n",
                      kTop + height / 2, escaped(y_.label));
}

std::string SvgPlot::svg() const {
  const double width = size_.width - kLeft - kRight, height = size_.height - kTop - kBottom;
  std::string out;
  base::append_format(out,
                      "<svg role=\"img\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\">\n",
                      size_.width, size_.height + (any_cut() ? kCutWords : 0));
  base::append_format(out, "<title>{}</title>\n", title_);
  append_axes(out);
  // A nested picture clips content outside the axes.
  base::append_format(out, "<svg x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\">\n{}</svg>\n", kLeft,
                      kTop, width, height, body_);
  base::append_format(out, "<path class=\"frame\" d=\"M{:.1f} {:.1f}h{:.1f}v{:.1f}h-{:.1f}Z\"/>\n", kLeft, kTop,
                      width, height, width);
  append_cuts(out);
  return out + legend_ + "</svg>\n";
}

}  // namespace navcal::report

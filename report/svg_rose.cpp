// SPDX-License-Identifier: Apache-2.0
#include "report/svg_rose.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace navcal::report {
namespace {

constexpr double kCentre = 160, kRadius = 122;

std::pair<double, double> place(double radius, double heading_deg) {
  const double angle = heading_deg * std::numbers::pi / 180;
  return {kCentre + radius * std::sin(angle), kCentre - radius * std::cos(angle)};
}

}  // namespace

std::string svg_rose(const calib::HeadingHistogram& rose) {
  const double most = std::max(1.0, static_cast<double>(*std::ranges::max_element(rose)));
  std::string out = fmt::format(
      "<svg role=\"img\" viewBox=\"0 0 {0:.0f} {0:.0f}\" width=\"{0:.0f}\" height=\"{0:.0f}\">\n"
      "<title>Headings visited</title>\n",
      2 * kCentre);
  for (const double share : {0.5, 1.0}) {
    fmt::format_to(std::back_inserter(out),
                   "<circle class=\"grid\" cx=\"{0:.0f}\" cy=\"{0:.0f}\" r=\"{1:.0f}\"/>\n", kCentre,
                   kRadius * share);
  }
  const double width_deg = 360.0 / static_cast<double>(rose.size());
  std::string sectors;
  for (std::size_t i = 0; i < rose.size(); ++i) {
    if (rose[i] == 0) continue;
    // A minimum length keeps the sector visible.
    const double radius = kRadius * std::max(0.08, std::sqrt(rose[i] / most));
    const auto [x1, y1] = place(radius, width_deg * static_cast<double>(i));
    const auto [x2, y2] = place(radius, width_deg * static_cast<double>(i + 1));
    fmt::format_to(std::back_inserter(sectors),
                   "M{0:.0f} {0:.0f}L{1:.1f} {2:.1f}A{3:.1f} {3:.1f} 0 0 1 {4:.1f} {5:.1f}Z", kCentre, x1, y1,
                   radius, x2, y2);
  }
  if (!sectors.empty()) out += "<path class=\"sector\" d=\"" + sectors + "\"/>\n";
  constexpr std::array<const char*, 8> kNames{"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto [x, y] = place(kRadius + 17, 45.0 * static_cast<double>(i));
    fmt::format_to(std::back_inserter(out), "<text text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                   x, y + 4, kNames[i]);
  }
  return out + "</svg>\n";
}

std::string text_rose(const calib::HeadingHistogram& rose) {
  const std::uint64_t most = *std::ranges::max_element(rose);
  std::string text;
  for (const std::uint64_t count : rose) text += count == 0 ? '.' : count * 5 < most ? ':' : '#';
  return text;
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include "report/plot_axes.h"

namespace navcal::report {
namespace {

constexpr std::size_t kSectors = 24;
constexpr double kSector_deg = 360.0 / kSectors;
constexpr std::array<const char*, 8> kMarks{"N", "NE", "E", "SE", "S", "SW", "W", "NW"};

double in_circle(double heading_deg) {
  const double rest = std::fmod(heading_deg, 360);
  return rest < 0 ? rest + 360 : rest;
}

}  // namespace

HeadingAxis::HeadingAxis(const std::vector<double>& headings_deg) {
  std::array<std::size_t, kSectors> counts{};
  for (const double heading_deg : headings_deg) {
    if (!std::isfinite(heading_deg)) continue;
    const auto sector = static_cast<std::size_t>(in_circle(heading_deg) / kSector_deg);
    ++counts.at(std::min(sector, kSectors - 1));
  }
  // The middle of the sector with the fewest headings, counted with its neighbours; of several the nearest to
  // south.
  std::size_t best = kSectors / 2, least = SIZE_MAX;
  for (std::size_t i = 0; i < kSectors; ++i) {
    const std::size_t sector = (kSectors / 2 + (i % 2 == 0 ? i / 2 : kSectors - (i + 1) / 2)) % kSectors;
    const std::size_t around =
        counts.at(sector) * 4 + counts.at((sector + 1) % kSectors) + counts.at((sector + kSectors - 1) % kSectors);
    if (around < least) {
      least = around;
      best = sector;
    }
  }
  least_deg_ = (static_cast<double>(best) + 0.5) * kSector_deg - 360;
}

double HeadingAxis::operator()(double heading_deg) const {
  return least_deg_ + in_circle(heading_deg - least_deg_);
}

SvgPlot::Axis HeadingAxis::axis(std::string label) const {
  SvgPlot::Axis axis{std::move(label), {least_deg_, least_deg_ + 360}};
  constexpr double kMark_deg = 45;
  for (double mark = std::ceil(least_deg_ / kMark_deg) * kMark_deg; mark <= axis.range.most; mark += kMark_deg) {
    const auto which = static_cast<std::size_t>(std::lround(in_circle(mark) / kMark_deg)) % kMarks.size();
    axis.ticks.push_back({mark, kMarks.at(which)});
  }
  return axis;
}

}  // namespace navcal::report

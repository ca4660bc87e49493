// SPDX-License-Identifier: Apache-2.0
#include "calib/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::calib {
namespace {

/// Sectors as degrees, for people.
std::string degrees(std::size_t sectors) {
  return std::to_string(sectors * static_cast<std::size_t>(kSector_deg));
}

}  // namespace

std::size_t sector_of(double heading_rad) {
  const double turns = heading_rad / (2 * std::numbers::pi);
  const double place = (turns - std::floor(turns)) * static_cast<double>(HeadingHistogram{}.size());
  return std::min(static_cast<std::size_t>(place), HeadingHistogram{}.size() - 1);
}

std::size_t visited(const HeadingHistogram& rose) {
  return static_cast<std::size_t>(std::count_if(rose.begin(), rose.end(), [](auto count) { return count > 0; }));
}

std::string missing_turn(const HeadingHistogram& rose) {
  const std::size_t n = rose.size();
  if (visited(rose) == 0) return "turn through 360 degrees";
  std::size_t longest = 0, first = 0;
  for (std::size_t begin = 0; begin < n; ++begin) {
    std::size_t length = 0;
    while (length < n && rose[(begin + length) % n] == 0) ++length;
    if (length > longest) {
      longest = length;
      first = begin;
    }
  }
  if (longest == 0) return {};
  return "turn through " + degrees(longest) + " more degrees, headings " + degrees(first) + " to " +
         degrees((first + longest) % n);
}

}  // namespace navcal::calib

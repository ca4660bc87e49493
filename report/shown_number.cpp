// SPDX-License-Identifier: Apache-2.0
#include "report/shown_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace navcal::report {
namespace {

constexpr int kLeastDecimals = 0, kMostDecimals = 6;

}  // namespace

int decimals_for(double value, double error) {
  const bool known = std::isfinite(error) && error > 0;
  const double guide = known ? error : std::abs(value) / 100;
  if (!(guide > 0)) return 3;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(guide))), kLeastDecimals, kMostDecimals);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  const auto whole = static_cast<long>(std::lround(std::max(seconds, 0.0)));
  if (whole < 60) return fmt::format("{:.1f} s", seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace navcal::report

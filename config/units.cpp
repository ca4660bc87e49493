// SPDX-License-Identifier: Apache-2.0
#include "config/units.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <string>

namespace navcal::config {

double shortest_decimal(double guess, const std::function<bool(double)>& holds) {
  for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    const std::string decimal = fmt::format("{:.{}g}", guess, digits);
    double candidate = guess;
    std::from_chars(decimal.data(), decimal.data() + decimal.size(), candidate);
    if (holds(candidate)) return candidate;
  }
  // Two roundings (there and back) can leave the guess a last place or two beside the number that holds.
  double below = guess;
  double above = guess;
  for (int step = 0; step < 2; ++step) {
    below = std::nextafter(below, -std::numeric_limits<double>::infinity());
    above = std::nextafter(above, std::numeric_limits<double>::infinity());
    if (holds(below)) return below;
    if (holds(above)) return above;
  }
  return guess;
}

}  // namespace navcal::config

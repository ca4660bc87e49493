// SPDX-License-Identifier: Apache-2.0
#include "report/gap_units.h"

#include <algorithm>
#include <array>

namespace navcal::report {
namespace {

constexpr std::array<std::string_view, 11> kChannelUnits{"uT", "deg", "rad", "s", "s2", "m",
                                                         "N",  "A",   "A2",  "C", "g"};

bool is_unit(std::string_view word) {
  return std::find(kChannelUnits.begin(), kChannelUnits.end(), word) != kChannelUnits.end();
}

}  // namespace

NameAndUnit name_and_unit(std::string_view parameter) {
  NameAndUnit split;
  bool per = false;
  while (!parameter.empty()) {
    const std::string_view word = parameter.substr(0, parameter.find('_'));
    parameter.remove_prefix(std::min(word.size() + 1, parameter.size()));
    if (word == "per") {
      per = true;
    } else if (is_unit(word)) {
      // Metres by seconds squared are written m_s2, without "per".
      if (!split.unit.empty()) split.unit += '/';
      if (split.unit.empty() && per) split.unit = "1/";
      split.unit += word;
    } else {
      if (!split.name.empty()) split.name += ' ';
      split.name += word;
    }
  }
  return split;
}

}  // namespace navcal::report

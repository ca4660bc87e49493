// SPDX-License-Identifier: Apache-2.0
// Any bytes as a file of effects: problems, or effects whose parameters are numbers within their ranges.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sim/effects/choice.h"
#include "sim/effects/document.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace navcal::sim;
  EffectSet set;
  std::vector<navcal::config::Problem> problems;
  add_effects({reinterpret_cast<const char*>(data), size}, set, problems);
  if (!problems.empty() && set.size() > 0) std::abort();
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto parameters = set[i].description().parameters;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (refusal(parameters[k], set[i].parameters()[k])) std::abort();
    }
    if (!(set.interval(i).from_s < set.interval(i).until_s)) std::abort();
  }
  return 0;
}

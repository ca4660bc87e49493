// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/advice.h"

namespace navcal::gap {

std::string tie_breaker(const sim::EffectDescription& one, const sim::EffectDescription& other) {
  const std::string_view first = one.manoeuvre.text(), second = other.manoeuvre.text();
  if (first == second) return std::string(first);
  return std::string(first) + "; and " + std::string(second);
}

}  // namespace navcal::gap

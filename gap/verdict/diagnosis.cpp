// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/diagnosis.h"

#include <array>

namespace navcal::gap {

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::no_gap: return "no-gap";
    case Verdict::explained: return "explained";
    case Verdict::unknown: break;
  }
  return "unknown";
}

std::string_view name_of(UnknownKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"ambiguous", "outside", "cannot say"};
  return kNames.at(static_cast<std::size_t>(kind));
}

}  // namespace navcal::gap

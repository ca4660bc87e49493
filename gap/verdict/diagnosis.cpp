// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/diagnosis.h"

namespace navcal::gap {

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::no_gap: return "no-gap";
    case Verdict::explained: return "explained";
    case Verdict::unknown: break;
  }
  return "unknown";
}

}  // namespace navcal::gap

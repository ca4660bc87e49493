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

std::string_view name_of(UnknownKind kind) {
  switch (kind) {
    case UnknownKind::ambiguous: return "ambiguous";
    case UnknownKind::outside: return "outside";
    case UnknownKind::cannot_say: break;
  }
  return "cannot say";
}

}  // namespace navcal::gap

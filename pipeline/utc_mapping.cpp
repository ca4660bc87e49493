// SPDX-License-Identifier: Apache-2.0
#include "pipeline/utc_mapping.h"

namespace navcal::pipeline {

std::string_view name_of(UtcMapping::Source source) {
  switch (source) {
    case UtcMapping::Source::none: return "none";
    case UtcMapping::Source::file: return "file";
    case UtcMapping::Source::system: return "system";
    case UtcMapping::Source::system_synchronised: return "system-synchronised";
    case UtcMapping::Source::gps: return "gps";
  }
  return "none";
}

}  // namespace navcal::pipeline

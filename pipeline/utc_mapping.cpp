// SPDX-License-Identifier: Apache-2.0
#include "pipeline/utc_mapping.h"

#include "base/enum_name.h"

namespace navcal::pipeline {

std::string_view name_of(UtcMapping::Source source) {
  return base::enum_name<UtcMapping::Source::gps>(source,
                                                  {"none", "file", "system", "system-synchronised", "gps"});
}

}  // namespace navcal::pipeline

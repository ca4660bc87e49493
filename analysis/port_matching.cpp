// SPDX-License-Identifier: Apache-2.0
#include "analysis/port_matching.h"

#include <cstdio>

#include "base/printable.h"

namespace navcal::analysis {

record::PortMatch match_ports(const config::Settings& recorded, const config::Settings& used,
                              const std::string& file) {
  record::PortMatch match(recorded, used);
  for (const std::string& remark : match.remarks(file))
    std::fprintf(stderr, "navcal: %s\n", base::printable(remark).c_str());
  return match;
}

}  // namespace navcal::analysis

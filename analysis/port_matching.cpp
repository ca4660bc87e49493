// SPDX-License-Identifier: Apache-2.0
#include "analysis/port_matching.h"

#include <cstdio>

namespace navcal::analysis {

record::PortMatch match_ports(const config::Settings& recorded, const config::Settings& used,
                              const std::string& file) {
  record::PortMatch match(recorded, used);
  for (const std::string& port : match.missing()) {
    std::fprintf(stderr, "navcal: %s: port %s is not in the configuration: left out\n", file.c_str(),
                 port.c_str());
  }
  return match;
}

}  // namespace navcal::analysis

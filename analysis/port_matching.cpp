// SPDX-License-Identifier: Apache-2.0
#include "analysis/port_matching.h"

#include <cstdio>

#include "base/printable.h"

namespace navcal::analysis {

std::string missing_port_remark(const std::string& file, const std::string& port) {
  return file + ": port " + port + " is not in the configuration: left out";
}

record::PortMatch match_ports(const config::Settings& recorded, const config::Settings& used,
                              const std::string& file) {
  record::PortMatch match(recorded, used);
  for (const std::string& port : match.missing()) {
    std::fprintf(stderr, "navcal: %s\n", base::printable(missing_port_remark(file, port)).c_str());
  }
  return match;
}

}  // namespace navcal::analysis

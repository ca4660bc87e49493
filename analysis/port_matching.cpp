// SPDX-License-Identifier: Apache-2.0
#include "analysis/port_matching.h"

#include <algorithm>
#include <cstdio>

namespace navcal::analysis {

std::vector<int> match_ports(const config::Settings& recorded, const config::Settings& used,
                             const std::string& file) {
  std::vector<int> index;
  for (const auto& port : recorded.ports) {
    const auto found = std::find_if(used.ports.begin(), used.ports.end(),
                                    [&](const config::PortSettings& other) { return other.name == port.name; });
    index.push_back(found == used.ports.end() ? -1 : static_cast<int>(found - used.ports.begin()));
    if (found == used.ports.end()) {
      std::fprintf(stderr, "navcal: %s: port %s is not in the configuration: left out\n", file.c_str(),
                   port.name.c_str());
    }
  }
  return index;
}

}  // namespace navcal::analysis

// SPDX-License-Identifier: Apache-2.0
#include "record/port_matching.h"

#include <algorithm>

namespace navcal::record {

PortMatch::PortMatch(const config::Settings& recorded, const config::Settings& used) {
  for (const auto& port : recorded.ports) {
    const auto found = std::find_if(used.ports.begin(), used.ports.end(),
                                    [&](const config::PortSettings& other) { return other.name == port.name; });
    if (found == used.ports.end()) {
      used_.emplace_back();
      missing_.push_back(port.name);
    } else {
      used_.emplace_back(static_cast<std::uint16_t>(found - used.ports.begin()));
    }
  }
}

}  // namespace navcal::record

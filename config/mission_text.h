// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "config/mission.h"

namespace navcal::config {

/// The mission as a file that parse_mission() reads back, numbers to four decimals. `head`: lines of comment at
/// the top, without their `#`; may be empty.
[[nodiscard]] std::string mission_text(const Mission& mission, std::string_view head = {});

}  // namespace navcal::config

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "analysis/emulate_session.h"

namespace navcal::cli {

inline constexpr std::string_view kConsoleHelp =
    "unplug PORT | replug PORT | power-cycle PORT | stall PORT SECONDS | noise PROB [PORT] | drop PROB [PORT] | "
    "imu-status BITS | quit";

/// One line of what people (or a test) type at a running emulator. Empty when it was done, else why not.
[[nodiscard]] std::string obey_line(analysis::EmulateSession& session, std::string_view line);

}  // namespace navcal::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "link/host.h"
#include "link/report.h"

namespace navcal::cli {

/// One line for people.
[[nodiscard]] std::string words_of(const link::Report& report);
/// "alive, loss 3 % in, 0 % out, round trip 0.21 s"
[[nodiscard]] std::string words_of(const link::Host::Quality& quality, bool is_alive);
/// One object without a line end: {"class":"REPORT",...}; what is not known is null.
[[nodiscard]] std::string json_of(const link::Host::NewReport& report, const link::Host::Quality& quality,
                                  bool is_alive);

}  // namespace navcal::cli

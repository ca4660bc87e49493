// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "config/load.h"

namespace navcal::config {

/// A port that is all right, for files in which something else is wrong; five lines.
inline constexpr std::string_view kGoodPort =
    "[port.gps]\nprotocol = \"oncore\"\npath = \"/dev/ttyS0\"\nbaud = 9600\n\n";

/// Problems reported for a file, line by line; empty if it is accepted.
inline std::vector<std::string> problems_of(std::string_view toml, const Overrides& overrides = {}) {
  try {
    static_cast<void>(parse(toml, "t.toml", overrides));
    return {};
  } catch (const Error& error) {
    return error.problems();
  }
}

/// The same, of a file with a good port in front: the given lines begin at line 6.
inline std::vector<std::string> problems_beside_a_port(std::string_view toml) {
  return problems_of(std::string(kGoodPort).append(toml));
}

using Problems = std::vector<std::string>;

}  // namespace navcal::config

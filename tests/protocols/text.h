// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocols/checked_line.h"
#include "protocols/frame.h"

// Frames of the ASCII devices as text.
namespace navcal::protocols::test {

inline Bytes bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

inline std::string text_of(Bytes bytes) { return {bytes.begin(), bytes.end()}; }

/// `$<body>*hh<CR><LF>` with a good checksum.
inline std::string line(std::string_view body) { return text_of(checked_line(body)); }

}  // namespace navcal::protocols::test

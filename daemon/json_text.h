// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::daemon {

// JSON text appended to a reused buffer. Live reports are written this way because a document tree costs twenty
// times as much a line; requests, which are rare, are read with nlohmann-json.

/// End of each line of the status socket: gpsd's client for Python takes no other.
inline constexpr std::string_view kLineEnd = "\r\n";

/// `text` in quotes. Whatever is not printable ASCII is escaped byte by byte, so the result is valid JSON for any
/// input.
void append_quoted(std::string& out, std::string_view text);

/// `"a","b"`: the texts with commas between them.
void append_quoted_list(std::string& out, const std::vector<std::string>& texts);

/// `value` rounded to `decimals` (0..9) places, all of them written: 1.5 -> "1.5000".
void append_fixed(std::string& out, double value, int decimals);

/// `value` rounded to `decimals` (0..9) places, the shortest text that says it: 12.330000 -> "12.33".
void append_shortest(std::string& out, double value, int decimals);

/// ISO 8601 in quotes with `decimals` (0..9) places of the second: "2026-03-01T00:00:00.100Z". Rounds down.
void append_utc(std::string& out, std::int64_t utc_ns, int decimals);

}  // namespace navcal::daemon

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace navcal::base {

/// "2030-01-01" of a time in nanoseconds of UTC since 1970, which may be negative.
[[nodiscard]] std::string utc_date_text(std::int64_t utc_ns);

/// "2030-01-01T00:00:45.312Z" (ISO 8601) of such a time; what is finer than a millisecond is cut off.
[[nodiscard]] std::string utc_text(std::int64_t utc_ns);

}  // namespace navcal::base

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "pipeline/utc_mapping.h"

namespace navcal::record {

/// Appends {"class":"TIME","time","monotonic","source","offset","bound","at"}: all in seconds with nine decimals,
/// `time` and `monotonic` being the same instant on both scales; an unknown bound is null.
void append_json(std::string& out, std::int64_t now_ns, const pipeline::UtcMapping& mapping);

/// The mapping in such an object, to the nanosecond; nullopt when it is not one.
[[nodiscard]] std::optional<pipeline::UtcMapping> mapping_from_json(std::string_view json);

/// Nanoseconds of a decimal such as "1893456000.104697202", without rounding; nullopt when it is not one or has
/// more than nine decimals.
[[nodiscard]] std::optional<std::int64_t> nanoseconds(std::string_view seconds);

}  // namespace navcal::record

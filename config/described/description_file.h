// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/document.h"
#include "config/error.h"
#include "protocols/described/description.h"

namespace navcal::config {

/// Longest description, in bytes: it becomes part of the configuration that a log has.
inline constexpr std::size_t kMaxDescription = 32 << 10;

/// Reads the description of a device (docs/devices.md). Throws Error with all its problems; `name` stands for the
/// file in them.
[[nodiscard]] protocols::described::Description parse_description(std::string_view toml, std::string_view name);
[[nodiscard]] protocols::described::Description load_description(const std::filesystem::path& file);

/// The same without an exception: notes problems, with the lines of the description.
[[nodiscard]] protocols::described::Description read_description(std::string_view toml,
                                                                 std::vector<Problem>& problems);

/// Changes zero, scale and sensitivity of fields for a single device: "rate.x: zero = 2051, sensitivity = 10.02".
/// Returns what is wrong with the text, or nullopt.
[[nodiscard]] std::optional<std::string> adjust(protocols::described::Description& description,
                                                std::string_view adjustment);

}  // namespace navcal::config

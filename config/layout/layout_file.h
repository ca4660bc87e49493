// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/document.h"
#include "config/error.h"
#include "config/layout.h"

namespace navcal::config {

/// Longest file of a layout, in bytes.
inline constexpr std::size_t kMaxLayout = 64 << 10;

/// Reads the layout of a vehicle (docs/vehicles.md). Throws Error with all its problems, each with line, key, unit
/// and bounds; `name` stands for the file in them. A layout that was read may still be odd: navcal vehicle check.
[[nodiscard]] Layout load_layout(const std::filesystem::path& file);
[[nodiscard]] Layout parse_layout(std::string_view toml, std::string_view name);

/// Whether a file describes a layout: it has one of the tables body, added_mass, thruster, surface, ballast and
/// moving_mass. Else it is a vehicle file.
[[nodiscard]] bool is_layout(std::string_view toml);

/// The same without an exception: notes problems.
[[nodiscard]] Layout read_layout(std::string_view toml, std::vector<Problem>& problems);

/// A file of this layout: parse_layout() gives it back to the last bit, angles to the last but one.
[[nodiscard]] std::string layout_file(const Layout& layout);

}  // namespace navcal::config

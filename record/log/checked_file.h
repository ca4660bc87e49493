// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace navcal::record {

/// A small file that holds one value and survives a loss of power at any instant: it is either the old value or
/// the new one. Written beside, brought to the disk, renamed over the old one, the folder brought to the disk. A
/// CRC-32C tells damage.
[[nodiscard]] std::error_code write_checked(const std::filesystem::path& file, std::string_view content);

struct CheckedContent {
  enum class State : std::uint8_t { good, absent, damaged };
  State state = State::absent;
  std::string content;  ///< when good
  std::string reason;   ///< when damaged, for people
};
[[nodiscard]] CheckedContent read_checked(const std::filesystem::path& file);

}  // namespace navcal::record

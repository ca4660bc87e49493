// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace navcal::record {

/// Two small hexadecimal digits for each byte.
void append_hexadecimal(std::string& text, std::span<const unsigned char> bytes);
[[nodiscard]] std::string hexadecimal(std::span<const unsigned char> bytes);

/// SHA-256 in hexadecimal, small letters.
[[nodiscard]] std::string sha256_of(std::string_view text);

/// The same of the content of a file. Throws std::system_error, which names the file.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace navcal::record

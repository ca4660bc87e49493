// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace navcal::record {

/// Size of a pipe or another source of unknown length.
inline constexpr std::uint64_t kUnknownSize = UINT64_MAX;

/// Bytes that are read once, from front to back.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Up to `n` bytes; 0 only at the end. Throws std::system_error when the medium fails.
  virtual std::size_t read(char* to, std::size_t n) = 0;
  /// Length when it was opened, or kUnknownSize.
  [[nodiscard]] virtual std::uint64_t size() const = 0;
};

/// Throws std::system_error, which names the file.
[[nodiscard]] std::unique_ptr<ByteSource> open_file(const std::filesystem::path& file);

}  // namespace navcal::record

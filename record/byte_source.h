// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <system_error>

namespace navcal::record {

/// Size of a pipe or another source of unknown length.
inline constexpr std::uint64_t kUnknownSize = UINT64_MAX;

/// A file that is to be read and cannot be: bad input, unlike one that is to be written.
class UnreadableFile : public std::system_error {
 public:
  explicit UnreadableFile(const std::filesystem::path& file, int error = errno)
      : std::system_error(error, std::system_category(), file.string()) {}
};

/// Bytes that are read once, from front to back.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Up to `n` bytes; 0 only at the end. Throws UnreadableFile when the medium fails.
  virtual std::size_t read(char* to, std::size_t n) = 0;
  /// Length when it was opened, or kUnknownSize.
  [[nodiscard]] virtual std::uint64_t size() const = 0;
};

/// Throws UnreadableFile.
[[nodiscard]] std::unique_ptr<ByteSource> open_file(const std::filesystem::path& file);

}  // namespace navcal::record

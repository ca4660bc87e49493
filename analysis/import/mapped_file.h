// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace navcal::analysis {

/// A regular file as bytes in memory, which the system reads when they are used. Throws std::system_error, which
/// names the file. Bytes that cannot be read any more, because the file was cut or its disk fails, are zero: see
/// is_whole(). One file at a time in a thread, and only that thread reads the bytes.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  [[nodiscard]] std::string_view bytes() const { return {data_, size_}; }
  /// False when bytes that were used could not be read.
  [[nodiscard]] bool is_whole() const;

 private:
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace navcal::analysis

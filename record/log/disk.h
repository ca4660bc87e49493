// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "record/byte_source.h"

namespace navcal::record {

/// A file open for writing. While it is open nobody else who asks the same way can open it (flock).
class DiskFile {
 public:
  virtual ~DiskFile() = default;
  virtual std::error_code write_at(std::uint64_t offset, std::string_view bytes) = 0;
  /// Takes space from `offset` on, so that writing there later changes little on the medium; the length stays.
  /// truncate() gives back what was not used.
  virtual std::error_code reserve(std::uint64_t offset, std::uint64_t length) = 0;
  virtual std::error_code truncate(std::uint64_t length) = 0;
  /// Data and what is needed to find it again (fdatasync).
  virtual std::error_code sync() = 0;
  virtual std::error_code make_read_only() = 0;
  /// Somebody has removed it: what is written is lost when it is closed.
  [[nodiscard]] virtual bool is_gone() const { return false; }
};

/// Held while it lives.
class DiskLock {
 public:
  virtual ~DiskLock() = default;
};

struct DiskEntry {
  std::string name;
  std::uint64_t bytes = 0;
  bool writable = false;  ///< by its mode, whoever asks
};

/// The few file operations of the log, so that tests can stall them, fill the disk and cut the power between any
/// two.
class Disk {
 public:
  virtual ~Disk() = default;
  /// A new file; an error when the name is taken.
  virtual std::unique_ptr<DiskFile> create(const std::filesystem::path& file, std::error_code& error) = 0;
  /// An existing file; std::errc::resource_unavailable_try_again when another has it open.
  virtual std::unique_ptr<DiskFile> open(const std::filesystem::path& file, std::error_code& error) = 0;
  virtual std::unique_ptr<ByteSource> read(const std::filesystem::path& file, std::error_code& error) = 0;
  virtual std::error_code remove(const std::filesystem::path& file) = 0;
  /// Makes creations and removals in a folder last.
  virtual std::error_code sync_folder(const std::filesystem::path& folder) = 0;
  /// Regular files, in no order.
  virtual std::vector<DiskEntry> list(const std::filesystem::path& folder, std::error_code& error) = 0;
  virtual std::uint64_t free_bytes(const std::filesystem::path& folder, std::error_code& error) = 0;
  /// std::errc::resource_unavailable_try_again when another process holds it.
  virtual std::unique_ptr<DiskLock> lock(const std::filesystem::path& file, std::error_code& error) = 0;
};

/// The machine's.
[[nodiscard]] Disk& real_disk();

}  // namespace navcal::record

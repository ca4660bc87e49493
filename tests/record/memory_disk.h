// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <random>
#include <string>

#include "record/log/disk.h"

namespace navcal::record::testing {

/// A disk in memory whose power can fail before any of its operations, and whose space can run out.
class MemoryDisk final : public Disk {
 public:
  /// Operations that still succeed; then everything fails as if the machine were gone.
  std::uint64_t operations_left = UINT64_MAX;
  std::uint64_t operations = 0;
  std::uint64_t capacity = UINT64_MAX;

  /// State of the medium after a power cycle: all synced data, and of the rest any part from none to all, cut at a
  /// byte, or zeros where space was allocated.
  void power_cycle(std::mt19937& random);

  std::unique_ptr<DiskFile> create(const std::filesystem::path& file, std::error_code& error) override;
  std::unique_ptr<DiskFile> open(const std::filesystem::path& file, std::error_code& error) override;
  std::unique_ptr<ByteSource> read(const std::filesystem::path& file, std::error_code& error) override;
  std::error_code remove(const std::filesystem::path& file) override;
  std::error_code sync_folder(const std::filesystem::path& folder) override;
  std::vector<DiskEntry> list(const std::filesystem::path& folder, std::error_code& error) override;
  std::uint64_t free_bytes(const std::filesystem::path& folder, std::error_code& error) override;
  std::unique_ptr<DiskLock> lock(const std::filesystem::path& file, std::error_code& error) override;

  [[nodiscard]] const std::string& content(const std::string& name) const { return files_.at(name)->content; }
  [[nodiscard]] std::string& content(const std::string& name) { return files_.at(name)->content; }
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  struct Stored {
    std::string content;
    std::string synced;
    bool entry_synced = false;  ///< its name is on the medium
    bool writable = true;
    bool open = false;
  };
  class Handle;

  [[nodiscard]] std::error_code step();
  [[nodiscard]] std::uint64_t used() const;

  std::map<std::string, std::shared_ptr<Stored>> files_;
};

}  // namespace navcal::record::testing

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "record/log/disk.h"

namespace navcal::daemon {

/// The real disk with its bad habits under the control of a test.
class DifficultDisk : public record::Disk {
 public:
  std::atomic<bool> stalled{false};  ///< every write waits until this is over
  std::atomic<bool> full{false};     ///< every write fails for want of space
  std::atomic<bool> no_sync{false};  ///< every sync fails, and what was written since the last good one is dropped
  std::atomic<std::uint64_t> free{1ULL << 40};

  std::unique_ptr<record::DiskFile> create(const std::filesystem::path& file, std::error_code& error) override {
    auto real = record::real_disk().create(file, error);
    if (!real) return nullptr;
    return std::make_unique<File>(*this, std::move(real));
  }
  std::unique_ptr<record::DiskFile> open(const std::filesystem::path& file, std::error_code& error) override {
    return record::real_disk().open(file, error);
  }
  std::unique_ptr<record::ByteSource> read(const std::filesystem::path& file, std::error_code& error) override {
    return record::real_disk().read(file, error);
  }
  std::error_code remove(const std::filesystem::path& file) override {
    free += 1 << 20;
    full = false;
    return record::real_disk().remove(file);
  }
  std::error_code sync_folder(const std::filesystem::path& folder) override {
    return record::real_disk().sync_folder(folder);
  }
  std::vector<record::DiskEntry> list(const std::filesystem::path& folder, std::error_code& error) override {
    return record::real_disk().list(folder, error);
  }
  std::uint64_t free_bytes(const std::filesystem::path&, std::error_code&) override { return free; }
  std::unique_ptr<record::DiskLock> lock(const std::filesystem::path& file, std::error_code& error) override {
    return record::real_disk().lock(file, error);
  }

 private:
  class File : public record::DiskFile {
   public:
    File(DifficultDisk& disk, std::unique_ptr<record::DiskFile> real) : disk_(disk), real_(std::move(real)) {}
    std::error_code write_at(std::uint64_t offset, std::string_view bytes) override {
      while (disk_.stalled) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (disk_.full) return std::make_error_code(std::errc::no_space_on_device);
      if (const auto error = real_->write_at(offset, bytes)) return error;
      end_ = std::max(end_, offset + bytes.size());
      return {};
    }
    std::error_code reserve(std::uint64_t offset, std::uint64_t length) override {
      return real_->reserve(offset, length);
    }
    std::error_code truncate(std::uint64_t length) override { return real_->truncate(length); }
    std::error_code sync() override {
      if (disk_.no_sync) return drop_unsynced();
      if (const auto error = real_->sync()) return error;
      synced_ = end_;
      return {};
    }
    std::error_code make_read_only() override { return real_->make_read_only(); }
    [[nodiscard]] bool is_gone() const override { return real_->is_gone(); }

   private:
    /// Drops unsynced data as the kernel does: the pages are clean afterwards, and contain what is on the medium.
    std::error_code drop_unsynced() {
      const std::string hole(static_cast<std::size_t>(end_ - synced_), '\0');
      if (const auto error = real_->write_at(synced_, hole)) return error;
      return std::make_error_code(std::errc::io_error);
    }

    DifficultDisk& disk_;
    std::unique_ptr<record::DiskFile> real_;
    std::uint64_t end_ = 0, synced_ = 0;
  };
};

}  // namespace navcal::daemon

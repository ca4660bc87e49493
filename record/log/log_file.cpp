// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_file.h"

#include "record/log/reused_buffer.h"

namespace navcal::record {

LogFile::LogFile(std::unique_ptr<DiskFile> file, std::filesystem::path path)
    : file_(std::move(file)), path_(std::move(path)) {}

std::unique_ptr<LogFile> LogFile::create(Disk& disk, const std::filesystem::path& path, std::error_code& error) {
  error.clear();
  auto file = disk.create(path, error);
  if (!file) return nullptr;
  error = disk.sync_folder(path.has_parent_path() ? path.parent_path() : ".");
  if (error) return nullptr;
  return std::unique_ptr<LogFile>(new LogFile(std::move(file), path));
}

std::error_code LogFile::append(std::string_view bytes) {
  while (reserved_bytes_ < bytes_ + bytes.size()) {
    // On a disk that is nearly full this fails while the bytes themselves may still fit.
    if (file_->reserve(reserved_bytes_, kReserveStep)) break;
    reserved_bytes_ += kReserveStep;
  }
  const std::error_code error = file_->write_at(bytes_, bytes);
  if (error) return error;
  bytes_ += bytes.size();
  unsynced_ += bytes;
  return {};
}

std::error_code LogFile::sync() {
  if (write_anew_) {
    if (const auto error = file_->write_at(synced_bytes_, unsynced_)) return error;
  }
  const std::error_code error = file_->sync();
  write_anew_ = static_cast<bool>(error);
  if (error) return error;
  synced_bytes_ = bytes_;
  empty_for_reuse(unsynced_);
  return {};
}

std::error_code LogFile::finish() {
  if (const auto error = file_->truncate(bytes_)) return error;
  if (const auto error = sync()) return error;
  return file_->make_read_only();
}

}  // namespace navcal::record

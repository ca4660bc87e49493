// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_folder.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <numeric>
#include <optional>

#include "base/durations.h"
#include "protocols/decimal.h"
#include "record/log/reused_buffer.h"

namespace navcal::record {
namespace {

constexpr std::string_view kPrefix = "navcal-";
constexpr std::string_view kSuffix = ".mcap";
constexpr std::size_t kTime = 16;  // 20261121T023000Z
constexpr std::size_t kLeastDigits = 6;
constexpr std::string_view kLockName = "navcal.lock";

std::optional<std::uint64_t> counter_of(std::string_view name) {
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return std::nullopt;
  name.remove_prefix(kPrefix.size());
  name.remove_suffix(kSuffix.size());
  if (name.size() < kTime + 1 + kLeastDigits || name[kTime] != '-') return std::nullopt;
  name.remove_prefix(kTime + 1);
  return protocols::integer<std::uint64_t>(name);
}

std::string explain(const std::filesystem::path& folder, const std::error_code& error) {
  std::string what = "log folder " + folder.string();
  if (error == std::errc::resource_unavailable_try_again) return what + ": another navcald is writing logs there";
  if (error == std::errc::no_such_file_or_directory) return what + ": it does not exist";
  if (error == std::errc::read_only_file_system) return what + ": read-only here; a service needs ReadWritePaths=";
  if (error == std::errc::permission_denied) return what + ": this user may not write there";
  return what;
}

}  // namespace

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

struct LogFolder::Log {
  std::uint64_t counter = 0;
  std::string name;
  std::uint64_t bytes = 0;
  bool finished = false;
};

LogFolder::LogFolder(Disk& disk, std::filesystem::path folder) : disk_(disk), folder_(std::move(folder)) {
  std::error_code error;
  lock_ = disk_.lock(folder_ / kLockName, error);
  if (!lock_) throw std::system_error(error, explain(folder_, error));
  for (const Log& log : logs(error)) last_counter_ = std::max(last_counter_, log.counter);
  if (error) throw std::system_error(error, explain(folder_, error));
  kept_counter_ = last_counter_;
}

std::vector<LogFolder::Log> LogFolder::logs(std::error_code& error) {
  std::vector<Log> found;
  for (auto& entry : disk_.list(folder_, error)) {
    if (const auto counter = counter_of(entry.name))
      found.push_back({*counter, std::move(entry.name), entry.bytes, !entry.writable});
  }
  std::sort(found.begin(), found.end(), [](const Log& a, const Log& b) {
    return a.counter != b.counter ? a.counter < b.counter : a.name < b.name;
  });
  return found;
}

std::vector<Repair> LogFolder::finish_unfinished() {
  std::vector<Repair> repairs;
  std::error_code error;
  for (const Log& log : logs(error)) {
    if (!log.finished) repairs.push_back(finish_log(disk_, folder_ / log.name));
  }
  if (error) {
    Repair& failed = repairs.emplace_back();
    failed.file = folder_.string();
    failed.error = error;
  }
  return repairs;
}

std::unique_ptr<LogFile> LogFolder::create(std::int64_t utc_ns, std::error_code& error) {
  // Somebody may have copied logs here since: their counters are taken, too.
  for (const Log& log : logs(error)) last_counter_ = std::max(last_counter_, log.counter);
  if (error) return nullptr;
  return LogFile::create(disk_, folder_ / log_name(utc_ns, ++last_counter_), error);
}

std::vector<LogFolder::Log> LogFolder::removable(std::error_code& error) {
  auto found = logs(error);
  std::erase_if(found, [this](const Log& log) { return !log.finished || log.counter == kept_counter_; });
  return found;
}

void LogFolder::remove(const Log& log, Space& space) {
  if ((space.error = disk_.remove(folder_ / log.name))) return;
  space.removed.push_back(log.name);
  space.free_bytes = disk_.free_bytes(folder_, space.error);
}

LogFolder::Space LogFolder::keep_free(std::uint64_t floor_bytes) {
  Space space;
  space.free_bytes = disk_.free_bytes(folder_, space.error);
  if (space.error || space.free_bytes >= floor_bytes) return space;
  const auto old = removable(space.error);
  const std::uint64_t most_bytes = std::accumulate(
      old.begin(), old.end(), space.free_bytes, [](std::uint64_t sum, const Log& log) { return sum + log.bytes; });
  if (most_bytes < floor_bytes) return space;
  for (const Log& log : old) {
    if (space.error || space.free_bytes >= floor_bytes) break;
    remove(log, space);
  }
  return space;
}

LogFolder::Space LogFolder::remove_oldest() {
  Space space;
  const auto old = removable(space.error);
  if (!old.empty()) remove(old.front(), space);
  return space;
}

bool is_log_name(std::string_view name) {
  if (!counter_of(name)) return false;
  constexpr std::string_view kForm = "00000000T000000Z";
  static_assert(kForm.size() == kTime);
  const std::string_view time = name.substr(kPrefix.size(), kTime);
  for (std::size_t i = 0; i < kTime; ++i) {
    const bool is_digit = time[i] >= '0' && time[i] <= '9';
    if (kForm[i] == '0' ? !is_digit : time[i] != kForm[i]) return false;
  }
  return true;
}

std::string log_name(std::int64_t utc_ns, std::uint64_t counter) {
  const auto second = static_cast<std::time_t>(std::max<std::int64_t>(0, utc_ns) / base::kSecond_ns);
  return fmt::format("{}{:%Y%m%dT%H%M%SZ}-{:06}{}", kPrefix, fmt::gmtime(second), counter, kSuffix);
}

}  // namespace navcal::record

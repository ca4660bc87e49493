// SPDX-License-Identifier: Apache-2.0
#include "tests/record/memory_disk.h"

#include <algorithm>

#include "tests/record/memory_source.h"

namespace navcal::record::testing {
namespace {

std::error_code code(std::errc error) { return std::make_error_code(error); }

class OwnedSource final : public ByteSource {
 public:
  explicit OwnedSource(std::string bytes) : bytes_(std::move(bytes)), source_(bytes_) {}
  std::size_t read(char* to, std::size_t n) override { return source_.read(to, n); }
  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }

 private:
  std::string bytes_;
  MemorySource source_;
};

}  // namespace

class MemoryDisk::Handle final : public DiskFile {
 public:
  Handle(MemoryDisk& disk, std::shared_ptr<Stored> file) : disk_(disk), file_(std::move(file)) {
    file_->open = true;
  }
  ~Handle() override { file_->open = false; }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  std::error_code write_at(std::uint64_t offset, std::string_view bytes) override {
    if (const auto error = disk_.step()) return error;
    const std::uint64_t end = offset + bytes.size();
    const std::uint64_t growth = end > file_->content.size() ? end - file_->content.size() : 0;
    if (disk_.used() + growth > disk_.capacity) {
      // A real disk writes as much as fits, too.
      const std::uint64_t room = disk_.capacity - std::min(disk_.capacity, disk_.used());
      file_->content.resize(file_->content.size() + room);
      return code(std::errc::no_space_on_device);
    }
    if (growth > 0) file_->content.resize(end);
    file_->content.replace(offset, bytes.size(), bytes);
    return {};
  }
  std::error_code reserve(std::uint64_t offset, std::uint64_t length) override {
    if (const auto error = disk_.step()) return error;
    // A small step stands for 8 MB, so that zero tails are met without their size.
    const std::uint64_t end = offset + length / 8192;
    const std::uint64_t growth = end > file_->content.size() ? end - file_->content.size() : 0;
    if (disk_.used() + growth > disk_.capacity) return code(std::errc::no_space_on_device);
    file_->content.resize(file_->content.size() + growth);
    return {};
  }
  std::error_code truncate(std::uint64_t length) override {
    if (const auto error = disk_.step()) return error;
    file_->content.resize(length);
    return {};
  }
  std::error_code sync() override {
    if (const auto error = disk_.step()) return error;
    file_->synced = file_->content;
    return {};
  }
  std::error_code make_read_only() override {
    if (const auto error = disk_.step()) return error;
    file_->writable = false;
    return {};
  }

 private:
  MemoryDisk& disk_;
  std::shared_ptr<Stored> file_;
};

void MemoryDisk::power_cycle(std::mt19937& random) {
  operations_left = UINT64_MAX;
  for (auto file = files_.begin(); file != files_.end();) {
    Stored& stored = *file->second;
    if (!stored.entry_synced && random() % 2 == 0) {
      file = files_.erase(file);
      continue;
    }
    std::string survived = stored.synced;
    if (stored.content.size() > survived.size()) {
      const std::size_t more = random() % (stored.content.size() - survived.size() + 1);
      survived = stored.content.substr(0, survived.size() + more);
      if (random() % 2 == 0) survived.resize(survived.size() + random() % 1000, '\0');
    } else if (random() % 2 == 0) {
      survived = stored.content;
    }
    stored.content = stored.synced = survived;
    stored.open = false;
    ++file;
  }
}

std::error_code MemoryDisk::step() {
  if (operations_left == 0) return code(std::errc::io_error);
  --operations_left;
  ++operations;
  return {};
}

std::uint64_t MemoryDisk::used() const {
  std::uint64_t bytes = 0;
  for (const auto& [name, file] : files_) bytes += file->content.size();
  return bytes;
}

std::unique_ptr<DiskFile> MemoryDisk::create(const std::filesystem::path& file, std::error_code& error) {
  if ((error = step())) return nullptr;
  auto& stored = files_[file.filename()];
  if (stored) {
    error = code(std::errc::file_exists);
    return nullptr;
  }
  stored = std::make_shared<Stored>();
  return std::make_unique<Handle>(*this, stored);
}

std::unique_ptr<DiskFile> MemoryDisk::open(const std::filesystem::path& file, std::error_code& error) {
  if ((error = step())) return nullptr;
  const auto found = files_.find(file.filename());
  if (found == files_.end()) error = code(std::errc::no_such_file_or_directory);
  if (!error && found->second->open) error = code(std::errc::resource_unavailable_try_again);
  return error ? nullptr : std::make_unique<Handle>(*this, found->second);
}

std::unique_ptr<ByteSource> MemoryDisk::read(const std::filesystem::path& file, std::error_code& error) {
  const auto found = files_.find(file.filename());
  if (found == files_.end()) {
    error = code(std::errc::no_such_file_or_directory);
    return nullptr;
  }
  return std::make_unique<OwnedSource>(found->second->content);
}

std::error_code MemoryDisk::remove(const std::filesystem::path& file) {
  if (const auto error = step()) return error;
  return files_.erase(file.filename()) == 1 ? std::error_code{} : code(std::errc::no_such_file_or_directory);
}

std::error_code MemoryDisk::sync_folder(const std::filesystem::path& /*folder*/) {
  if (const auto error = step()) return error;
  for (auto& [name, file] : files_) file->entry_synced = true;
  return {};
}

std::vector<DiskEntry> MemoryDisk::list(const std::filesystem::path& /*folder*/, std::error_code& error) {
  error.clear();
  std::vector<DiskEntry> entries;
  for (const auto& [name, file] : files_) entries.push_back({name, file->content.size(), file->writable});
  return entries;
}

std::uint64_t MemoryDisk::free_bytes(const std::filesystem::path& /*folder*/, std::error_code& error) {
  error.clear();
  return capacity - std::min(capacity, used());
}

std::unique_ptr<DiskLock> MemoryDisk::lock(const std::filesystem::path& /*file*/, std::error_code& error) {
  error.clear();
  return std::make_unique<DiskLock>();
}

std::vector<std::string> MemoryDisk::names() const {
  std::vector<std::string> names;
  for (const auto& [name, file] : files_) names.push_back(name);
  return names;
}

}  // namespace navcal::record::testing

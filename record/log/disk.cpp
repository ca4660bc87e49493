// SPDX-License-Identifier: Apache-2.0
#include "record/log/disk.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "base/descriptor.h"

namespace navcal::record {
namespace {

std::error_code check(int result) { return result == 0 ? std::error_code{} : base::last_error(); }

class PosixFile final : public DiskFile {
 public:
  explicit PosixFile(base::Descriptor fd) : fd_(std::move(fd)) {}

  std::error_code write_at(std::uint64_t offset, std::string_view bytes) override {
    while (!bytes.empty()) {
      const ssize_t written = ::pwrite(fd_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
      if (written < 0) {
        if (errno == EINTR) continue;
        return base::last_error();
      }
      offset += static_cast<std::uint64_t>(written);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
  }
  std::error_code reserve(std::uint64_t offset, std::uint64_t length) override {
    // The length stays that of what was written, so that no reader meets zeros after a loss of power.
    const int result =
        ::fallocate(fd_.get(), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(offset), static_cast<off_t>(length));
    // A file system that cannot is used all the same: it only wears the flash more.
    return result != 0 && errno == EOPNOTSUPP ? std::error_code{} : check(result);
  }
  std::error_code truncate(std::uint64_t length) override {
    return check(::ftruncate(fd_.get(), static_cast<off_t>(length)));
  }
  std::error_code sync() override { return check(::fdatasync(fd_.get())); }
  [[nodiscard]] bool is_gone() const override {
    struct stat status {};
    return ::fstat(fd_.get(), &status) == 0 && status.st_nlink == 0;
  }
  std::error_code make_read_only() override {
    if (const auto error = check(::fchmod(fd_.get(), 0444))) return error;
    return check(::fsync(fd_.get()));
  }

 private:
  base::Descriptor fd_;
};

class PosixLock final : public DiskLock {
 public:
  explicit PosixLock(base::Descriptor fd) : fd_(std::move(fd)) {}

 private:
  base::Descriptor fd_;
};

/// Opens and locks; -1 and `error` when either fails.
base::Descriptor open_locked(const std::filesystem::path& file, int flags, std::error_code& error) {
  base::Descriptor fd(::open(file.c_str(), flags | O_CLOEXEC, 0644));
  if (!fd) {
    error = base::last_error();
    return fd;
  }
  error = check(::flock(fd.get(), LOCK_EX | LOCK_NB));
  return error ? base::Descriptor(-1) : std::move(fd);
}

class PosixDisk final : public Disk {
 public:
  std::unique_ptr<DiskFile> create(const std::filesystem::path& file, std::error_code& error) override {
    return file_of(open_locked(file, O_WRONLY | O_CREAT | O_EXCL, error));
  }
  std::unique_ptr<DiskFile> open(const std::filesystem::path& file, std::error_code& error) override {
    return file_of(open_locked(file, O_WRONLY, error));
  }
  std::unique_ptr<ByteSource> read(const std::filesystem::path& file, std::error_code& error) override {
    try {
      return open_file(file);
    } catch (const std::system_error& failure) {
      error = failure.code();
      return nullptr;
    }
  }
  std::error_code remove(const std::filesystem::path& file) override { return check(::unlink(file.c_str())); }
  std::error_code sync_folder(const std::filesystem::path& folder) override {
    const base::Descriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    return fd ? check(::fsync(fd.get())) : base::last_error();
  }
  std::vector<DiskEntry> list(const std::filesystem::path& folder, std::error_code& error) override {
    std::vector<DiskEntry> entries;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      // A file that has gone meanwhile is not there: no error of the list.
      struct stat status {};
      if (::lstat(entry->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
      entries.push_back({entry->path().filename().string(), static_cast<std::uint64_t>(status.st_size),
                         (status.st_mode & 0222U) != 0});
    }
    return entries;
  }
  std::uint64_t free_bytes(const std::filesystem::path& folder, std::error_code& error) override {
    struct statvfs status {};
    error = check(::statvfs(folder.c_str(), &status));
    return error ? 0 : static_cast<std::uint64_t>(status.f_bavail) * status.f_frsize;
  }
  std::unique_ptr<DiskLock> lock(const std::filesystem::path& file, std::error_code& error) override {
    base::Descriptor fd = open_locked(file, O_RDWR | O_CREAT, error);
    return fd ? std::make_unique<PosixLock>(std::move(fd)) : nullptr;
  }

 private:
  static std::unique_ptr<DiskFile> file_of(base::Descriptor fd) {
    return fd ? std::make_unique<PosixFile>(std::move(fd)) : nullptr;
  }
};

class FileSource final : public ByteSource {
 public:
  FileSource(base::Descriptor fd, std::uint64_t size, std::string name)
      : fd_(std::move(fd)), size_(size), name_(std::move(name)) {}

  std::size_t read(char* to, std::size_t n) override {
    for (;;) {
      const ssize_t got = ::read(fd_.get(), to, n);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) throw UnreadableFile(name_);
    }
  }
  [[nodiscard]] std::uint64_t size() const override { return size_; }

 private:
  base::Descriptor fd_;
  std::uint64_t size_;
  std::string name_;
};

}  // namespace

std::unique_ptr<ByteSource> open_file(const std::filesystem::path& file) {
  base::Descriptor fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (!fd || ::fstat(fd.get(), &status) != 0) throw UnreadableFile(file);
  if (S_ISDIR(status.st_mode)) throw UnreadableFile(file, EISDIR);
  const std::uint64_t size = S_ISREG(status.st_mode) ? static_cast<std::uint64_t>(status.st_size) : kUnknownSize;
  return std::make_unique<FileSource>(std::move(fd), size, file.string());
}

Disk& real_disk() {
  static PosixDisk disk;
  return disk;
}

}  // namespace navcal::record

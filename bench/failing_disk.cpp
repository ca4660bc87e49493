// SPDX-License-Identifier: Apache-2.0
// A disk that fails, for LD_PRELOAD in front of a daemon (bench/reliability storage). FAIL_WRITES_WHILE and
// FAIL_SYNCS_WHILE name files: as long as one is there, writes or syncs of regular files fail with EIO. What was
// written since the last good sync is lost by a failed one, as the kernel's cache forgets pages that it could not
// write.
#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <map>
#include <mutex>

namespace {

/// 0 when it is no regular file.
ino_t file_of(int fd) {
  struct stat status {};
  return ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode) ? status.st_ino : 0;
}

bool fails(const char* name) {
  const char* const flag = std::getenv(name);
  return flag != nullptr && ::access(flag, F_OK) == 0;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

auto* real_pwrite() {
  static auto* const function = real<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  return function;
}

/// Sizes of each file on the medium and, beyond it, in the cache.
struct Extent {
  off_t synced = 0, end = 0;
};
std::mutex mutex;
std::map<ino_t, Extent> extents;

}  // namespace

extern "C" {

ssize_t pwrite(int fd, const void* data, size_t size, off_t offset) {
  if (file_of(fd) != 0 && fails("FAIL_WRITES_WHILE")) {
    errno = EIO;
    return -1;
  }
  const ssize_t written = real_pwrite()(fd, data, size, offset);
  const std::lock_guard lock(mutex);
  Extent& extent = extents[file_of(fd)];
  if (written > 0 && offset + written > extent.end) extent.end = offset + written;
  return written;
}

int fdatasync(int fd) {
  static auto* const real_sync = real<int(int)>("fdatasync");
  const std::lock_guard lock(mutex);
  Extent& extent = extents[file_of(fd)];
  if (file_of(fd) != 0 && fails("FAIL_SYNCS_WHILE")) {
    const char zero = 0;
    for (off_t at = extent.synced; at < extent.end; ++at) real_pwrite()(fd, &zero, 1, at);
    errno = EIO;
    return -1;
  }
  const int result = real_sync(fd);
  if (result == 0) extent.synced = extent.end;
  return result;
}
}

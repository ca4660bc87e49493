// SPDX-License-Identifier: Apache-2.0
// A disk that stalls, for LD_PRELOAD in front of a daemon (bench/disk_stall): writes and syncs of regular files
// wait. STALL_WRITE_MS: every write; STALL_SYNC_MS and STALL_EVERY_S: one sync each so many seconds.
#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

long setting(const char* name) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atol(text) : 0;
}

bool is_file(int fd) {
  struct stat status {};
  return ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
}

void stall(const char* name) { std::this_thread::sleep_for(milliseconds(setting(name))); }

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

/// Whether this sync is one of those that hang.
bool is_due() {
  static const steady_clock::time_point began = steady_clock::now();
  static std::atomic<long> stalls{1};
  const long every_s = setting("STALL_EVERY_S");
  const auto passed_s = std::chrono::duration_cast<std::chrono::seconds>(steady_clock::now() - began).count();
  if (every_s == 0 || passed_s < stalls * every_s) return false;
  ++stalls;
  return true;
}

}  // namespace

extern "C" {

ssize_t pwrite(int fd, const void* data, size_t size, off_t offset) {
  if (is_file(fd)) stall("STALL_WRITE_MS");
  static auto* const real_write = real<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  return real_write(fd, data, size, offset);
}

int fdatasync(int fd) {
  if (is_due()) stall("STALL_SYNC_MS");
  static auto* const real_sync = real<int(int)>("fdatasync");
  return real_sync(fd);
}
}

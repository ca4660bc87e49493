// SPDX-License-Identifier: Apache-2.0
// Counts a program's allocations, for LD_PRELOAD (bench/reliability memory): the file ALLOCATIONS_FILE holds three
// counters of eight bytes that go on while it runs, those of malloc, calloc and realloc.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
}

namespace {

using Counter = std::atomic<std::uint64_t>;
enum Kind { kMalloc, kCalloc, kRealloc, kKinds };

Counter before_the_file_is_there[kKinds];
std::atomic<Counter*> counters{before_the_file_is_there};

__attribute__((constructor)) void open_file() {
  const char* const path = std::getenv("ALLOCATIONS_FILE");
  const int fd = path != nullptr ? ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0644) : -1;
  if (fd < 0) return;
  constexpr std::size_t kSize = sizeof(Counter) * kKinds;
  void* const shared =
      ::ftruncate(fd, kSize) == 0 ? ::mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0) : MAP_FAILED;
  if (shared != MAP_FAILED) counters = static_cast<Counter*>(shared);
  ::close(fd);
}

void count(Kind kind) { ++counters.load()[kind]; }

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  count(kMalloc);
  return __libc_malloc(size);
}

void* calloc(std::size_t count_of, std::size_t size) {
  count(kCalloc);
  return __libc_calloc(count_of, size);
}

void* realloc(void* old, std::size_t size) {
  count(kRealloc);
  return __libc_realloc(old, size);
}
}

// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/mapped_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

#include "base/descriptor.h"
#include "record/byte_source.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

/// The mapping of this thread, for the handler.
struct Mapping {
  std::uintptr_t begin = 0, end = 0;
  volatile bool is_whole = true;
};
thread_local Mapping thread_mapping;

/// A page that cannot be read, and all behind it, become zero. The signal of another address does what it always
/// does.
void on_bus_error(int /*signal*/, siginfo_t* info, void* /*context*/) {
  const auto at = reinterpret_cast<std::uintptr_t>(info->si_addr);
  const auto page = at - at % static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const bool is_ours = at >= thread_mapping.begin && at < thread_mapping.end;
  thread_mapping.is_whole = thread_mapping.is_whole && !is_ours;
  void* const begin = reinterpret_cast<void*>(page);  // NOLINT(performance-no-int-to-ptr)
  if (!is_ours || ::mmap(begin, thread_mapping.end - page, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1,
                         0) == MAP_FAILED)
    ::signal(SIGBUS, SIG_DFL);
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
  const auto fail = [&](int error) { throw record::UnreadableFile(path, error); };
  const base::Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat found {};
  if (!file || ::fstat(file.get(), &found) != 0) fail(errno);
  if (S_ISDIR(found.st_mode)) fail(EISDIR);
  if (!S_ISREG(found.st_mode))
    throw record::BadRecording(path.string() + ": a pipe or a device; logs are read from files");
  size_ = static_cast<std::size_t>(found.st_size);
  if (size_ == 0) return;
  void* const mapped = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (mapped == MAP_FAILED) fail(errno);
  ::madvise(mapped, size_, MADV_SEQUENTIAL);
  data_ = static_cast<const char*>(mapped);
  thread_mapping = {reinterpret_cast<std::uintptr_t>(data_), reinterpret_cast<std::uintptr_t>(data_) + size_};
  struct sigaction action {};
  action.sa_sigaction = on_bus_error;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
}

bool MappedFile::is_whole() const { return thread_mapping.is_whole; }

MappedFile::~MappedFile() {
  if (data_ != nullptr) ::munmap(const_cast<char*>(data_), size_);
  thread_mapping = {};
}

}  // namespace navcal::analysis

// SPDX-License-Identifier: Apache-2.0
#include "ports/holder.h"

#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>

namespace navcal::ports {
namespace {

namespace fs = std::filesystem;

bool has_open(const fs::path& process, const fs::path& device) {
  std::error_code error;
  for (fs::directory_iterator fd(process / "fd", error), end; !error && fd != end; fd.increment(error)) {
    std::error_code gone;  // descriptors of others come and go while we look
    if (fs::read_symlink(fd->path(), gone) == device && !gone) return true;
  }
  return false;
}

}  // namespace

bool lock_device(int fd) { return ::flock(fd, LOCK_EX | LOCK_NB) == 0; }

std::string visible_holders_of(const std::string& device) {
  std::string holders;
  std::error_code error;
  for (fs::directory_iterator entry("/proc", error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    int pid = 0;
    if (std::from_chars(name.data(), name.data() + name.size(), pid).ptr != name.data() + name.size()) continue;
    if (pid == ::getpid() || !has_open(entry->path(), device)) continue;
    std::string command;
    std::getline(std::ifstream(entry->path() / "comm"), command);
    holders += fmt::format("{}{} (process {})", holders.empty() ? "" : ", ", command, pid);
  }
  return holders;
}

std::string holders_of(const std::string& device) {
  if (std::string holders = visible_holders_of(device); !holders.empty()) return holders;
  return has_open("/proc/self", device) ? "this process" : "another user's process";
}

}  // namespace navcal::ports

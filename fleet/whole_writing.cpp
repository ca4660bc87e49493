// SPDX-License-Identifier: Apache-2.0
#include "fleet/whole_writing.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "base/descriptor.h"
#include "protocols/decimal.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_at(const fs::path& file) { throw std::system_error(base::last_error(), file.string()); }

void sync(const fs::path& path) {
  const base::Descriptor opened(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!opened || ::fsync(opened.get()) != 0) fail_at(path);
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

constexpr std::string_view kPart = ".part";

std::string host_name() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return host.data();
}

/// Whether this is the name that part_of() gave a process of this machine that has ended.
bool is_leftover(std::string_view name) {
  if (!name.starts_with('.') || !name.ends_with(kPart)) return false;
  name.remove_suffix(kPart.size());
  const auto dot = name.rfind('.');
  if (dot == std::string_view::npos || !name.substr(0, dot).ends_with("." + host_name())) return false;
  const auto pid = protocols::integer<pid_t>(name.substr(dot + 1)).value_or(0);
  return pid > 0 && ::kill(pid, 0) != 0 && errno == ESRCH;
}

void write_all(int to, std::string_view content, const fs::path& file) {
  while (!content.empty()) {
    const ssize_t count = ::write(to, content.data(), content.size());
    if (count < 0 && errno != EINTR) fail_at(file);
    if (count > 0) content.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace

fs::path part_of(const fs::path& file) {
  return folder_of(file) / fmt::format(".{}.{}.{}{}", file.filename().string(), host_name(), ::getpid(), kPart);
}

void write_whole(const fs::path& file, std::string_view content) {
  const fs::path part = part_of(file);
  try {
    const base::Descriptor out(::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (!out) fail_at(part);
    write_all(out.get(), content, part);
    if (::fsync(out.get()) != 0) fail_at(part);
    if (::rename(part.c_str(), file.c_str()) != 0) fail_at(file);
    sync(folder_of(file));
  } catch (...) {
    ::unlink(part.c_str());
    throw;
  }
}

bool rename_whole(const fs::path& from, const fs::path& to) {
  if (fs::is_directory(from)) {
    for (const auto& entry : fs::directory_iterator(from)) sync(entry.path());
  }
  sync(from);
  if (::rename(from.c_str(), to.c_str()) == 0) {
    sync(folder_of(to));
    return true;
  }
  if (errno != ENOTEMPTY && errno != EEXIST) fail_at(to);
  fs::remove_all(from);
  return false;
}

void remove_leftovers(const fs::path& folder) {
  std::error_code missing, kept;
  for (fs::directory_iterator at(folder, missing), end; !missing && at != end; at.increment(missing)) {
    if (is_leftover(at->path().filename().string())) fs::remove_all(at->path(), kept);
  }
}

}  // namespace navcal::fleet

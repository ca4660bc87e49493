// SPDX-License-Identifier: Apache-2.0
#include "ports/pseudo_terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "ports/raw_mode.h"

namespace navcal::ports {

PseudoTerminal make_pseudo_terminal(int baud) {
  const auto failed = [](const char* what) { throw std::system_error(errno, std::generic_category(), what); };
  PseudoTerminal made{base::Descriptor(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)), {}};
  if (!made.master) failed("no pseudo-terminal to be had");
  if (::grantpt(made.master.get()) != 0 || ::unlockpt(made.master.get()) != 0)
    failed("unlocking a pseudo-terminal");
  std::array<char, 64> name{};
  if (const int error = ::ptsname_r(made.master.get(), name.data(), name.size()); error != 0) {
    errno = error;
    failed("naming a pseudo-terminal");
  }
  made.slave_name = name.data();
  // Opened and closed once: the slave's settings stay, and from now on the master shows that no client is
  // there.
  const base::Descriptor slave(::open(name.data(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!slave || !set_raw(slave.get(), baud)) failed("setting up a pseudo-terminal");
  return made;
}

base::Descriptor keep_link(const std::filesystem::path& link) {
  namespace fs = std::filesystem;
  const fs::path full = fs::weakly_canonical(fs::absolute(link).parent_path()) / link.filename();
  // A name without a file (unix(7), abstract): the kernel forgets it with the process.
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  fmt::format_to_n(&address.sun_path[1], sizeof address.sun_path - 1, "navcal/{:x}", fs::hash_value(full));
  base::Descriptor kept(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (kept && ::bind(kept.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error(
        fmt::format("{}: another navcal that runs has this port; end it, or give another --dir", link.string()));
  }
  return kept;
}

void point_link(const std::filesystem::path& link, const std::string& target) {
  namespace fs = std::filesystem;
  if (link.has_parent_path()) fs::create_directories(link.parent_path());
  const auto status = fs::symlink_status(link);
  if (fs::exists(status) && !fs::is_symlink(status)) {
    throw std::runtime_error(fmt::format("{} is there already and is no link", link.string()));
  }
  const fs::path fresh = link.string() + fmt::format(".{}.new", ::getpid());
  std::error_code none;
  fs::remove(fresh, none);
  fs::create_symlink(target, fresh);
  fs::rename(fresh, link);
}

void remove_link(const std::filesystem::path& link, const std::string& target) {
  std::error_code error;
  if (std::filesystem::read_symlink(link, error) == target && !error) std::filesystem::remove(link, error);
}

}  // namespace navcal::ports

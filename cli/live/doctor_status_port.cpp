// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>

#include "cli/live/doctor_checks.h"

namespace navcal::cli {
namespace {

namespace fs = std::filesystem;

/// Inode of the socket that listens on a port, from a table like /proc/net/tcp. It does not connect, because
/// socket activation would then start the service it asks about.
std::optional<std::string> listening_inode(const fs::path& table, std::uint16_t port) {
  constexpr const char* kListening = "0A";
  std::ifstream file(table);
  std::string line;
  std::getline(file, line);  // the head
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string number, local, remote, state, queues, timer, retransmissions, uid, timeout, inode;
    words >> number >> local >> remote >> state >> queues >> timer >> retransmissions >> uid >> timeout >> inode;
    const auto colon = local.rfind(':');
    if (!words || state != kListening || colon == std::string::npos) continue;
    unsigned value = 0;
    std::from_chars(local.data() + colon + 1, local.data() + local.size(), value, 16);
    if (value == port) return inode;
  }
  return std::nullopt;
}

std::optional<std::string> inode_of(std::uint16_t port, const fs::path& proc) {
  const auto inode = listening_inode(proc / "net/tcp", port);
  return inode ? inode : listening_inode(proc / "net/tcp6", port);
}

/// Name of the program with this socket, as far as its process is visible.
std::string program_with(const fs::path& proc, const std::string& inode) {
  const std::string link = "socket:[" + inode + "]";
  std::error_code error;
  for (fs::directory_iterator entry(proc, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::error_code hidden;
    for (fs::directory_iterator fd(entry->path() / "fd", hidden); !hidden && fd != end; fd.increment(hidden)) {
      std::error_code gone;
      if (fs::read_symlink(fd->path(), gone) != link) continue;
      std::string command;
      std::getline(std::ifstream(entry->path() / "comm"), command);
      return command;
    }
  }
  return {};
}

}  // namespace

bool is_free(std::uint16_t port, const fs::path& proc) { return !inode_of(port, proc); }

Finding check_status_port(const config::StatusSettings& settings, const fs::path& proc, const fs::path& etc) {
  const std::string topic = "status socket";
  const std::string place = fmt::format("TCP port {}", settings.port);
  const auto inode = inode_of(settings.port, proc);
  if (!inode) return good(topic, place + " is free");

  const std::string mend = "sudo systemctl disable --now gpsd.socket gpsd.service, or choose another status.port";
  const std::string program = program_with(proc, *inode);
  if (program == "navcald") return good(topic, place + " is served by navcald");
  const bool gpsd_enabled = fs::exists(etc / "systemd/system/sockets.target.wants/gpsd.socket");
  const bool navcald_enabled = fs::exists(etc / "systemd/system/sockets.target.wants/navcald.socket");
  if (program == "gpsd" || (gpsd_enabled && !navcald_enabled)) {
    return fault(topic, place + " is taken by gpsd", mend);
  }
  if (gpsd_enabled) return fault(topic, "gpsd.socket and navcald.socket are both enabled for " + place, mend);
  if (program.empty() || program == "systemd") {
    if (navcald_enabled) return good(topic, place + " is held by navcald.socket");
    return warning(topic, place + " is taken by a program that this user cannot identify",
                   "sudo navcal doctor names it");
  }
  return fault(topic, fmt::format("{} is taken by {}", place, program),
               "end that program, or choose another status.port");
}

}  // namespace navcal::cli

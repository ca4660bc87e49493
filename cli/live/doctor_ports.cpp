// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <grp.h>
#include <pwd.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/timex.h>
#include <unistd.h>

#include <algorithm>

#include "cli/live/doctor_checks.h"
#include "ports/finder.h"
#include "ports/holder.h"
#include "ports/sysfs.h"

namespace navcal::cli {

Finding check_clock() {
  timex state{};
  const int status = ::adjtimex(&state);
  return judge_clock({status != -1 && status != TIME_ERROR && (state.status & STA_UNSYNC) == 0,
                      static_cast<double>(state.maxerror) * 1e-6});
}

Finding judge_clock(const ClockState& state) {
  if (state.synchronised) {
    return good("clock", fmt::format("UTC is known within {:.3g} ms", state.max_error_s * 1e3));
  }
  return warning(
      "clock", "not synchronised: until a GPS fix, UTC is taken from the clock of the machine, with unknown error",
      "sudo timedatectl set-ntp true, if there is a network");
}

Finding check_limits(const config::Settings& settings) {
  rlimit descriptors{}, priority{};
  (void)::getrlimit(RLIMIT_NOFILE, &descriptors);
  (void)::getrlimit(RLIMIT_RTPRIO, &priority);
  return judge_limits(descriptors.rlim_cur, priority.rlim_cur, settings);
}

Finding judge_limits(std::uint64_t descriptors, std::uint64_t real_time_priority,
                     const config::Settings& settings) {
  constexpr std::uint64_t kOwn = 32;  // log, timers, sockets
  const std::uint64_t needed = settings.status.max_clients + settings.ports.size() + kOwn;
  if (descriptors < needed) {
    return warning("limits",
                   fmt::format("{} open files are allowed; {} clients and {} ports may take {}", descriptors,
                               settings.status.max_clients, settings.ports.size(), needed),
                   fmt::format("ulimit -n {}, or lower status.max_clients", needed));
  }
  return good("limits", fmt::format("{} open files; real-time priority {} (navcald needs none)", descriptors,
                                    real_time_priority > 0 ? "is allowed" : "is not allowed"));
}

namespace {

std::string mend_of_holder(const std::string& holder, const std::string& device) {
  const std::string tty = std::filesystem::path(device).filename();
  if (holder.starts_with("gpsd")) return "sudo systemctl disable --now gpsd.socket gpsd.service";
  if (holder.starts_with("ModemManager")) return "sudo systemctl disable --now ModemManager.service";
  if (holder.starts_with("agetty")) return "sudo systemctl disable --now serial-getty@" + tty + ".service";
  return "end that program: of two readers of a port each gets only a part of the bytes";
}

Account account_of(const passwd& entry) {
  Account account{entry.pw_name, entry.pw_uid, {}};
  int count = 64;
  account.groups.resize(static_cast<std::size_t>(count));
  if (::getgrouplist(entry.pw_name, entry.pw_gid, account.groups.data(), &count) < 0) {
    account.groups.resize(static_cast<std::size_t>(count));
    (void)::getgrouplist(entry.pw_name, entry.pw_gid, account.groups.data(), &count);
  }
  account.groups.resize(static_cast<std::size_t>(std::max(count, 0)));
  return account;
}

}  // namespace

Finding check_port(const config::PortSettings& settings, const Account& account) {
  const std::string topic = "port " + settings.name;
  // Whether a device answers there is for navcald to find out: many converters take one connection only.
  if (!settings.address.empty())
    return good(topic,
                fmt::format("{}: reached through the network; navcald says whether it answers", settings.address));
  std::string why;
  const auto found = ports::find_port(settings, why);
  if (!found) return fault(topic, why, "connect it; `navcal ports` lists the ports and how to configure them");

  const std::string what =
      found->description.empty() ? found->path : fmt::format("{} ({})", found->path, found->description);
  if (!may_read_and_write(account, std::filesystem::path(found->path))) {
    const std::string group = group_of(found->path);
    return fault(topic, fmt::format("{}: {} may not read and write it", what, account.name),
                 fmt::format("sudo usermod -aG {} {}, then log in again", group, account.name));
  }
  if (const std::string holders = ports::visible_holders_of(found->path); !holders.empty()) {
    if (holders.starts_with("navcald")) return good(topic, fmt::format("{}, read by {}", what, holders));
    return fault(topic, fmt::format("{} is held by {}", what, holders), mend_of_holder(holders, found->path));
  }
  if (const auto timer_ms = ports::SysfsTty(found->path).latency_timer_ms(); timer_ms && *timer_ms > 1) {
    const std::string tty = std::filesystem::path(found->path).filename();
    return warning(topic, fmt::format("{}: its adapter delays bytes by {} ms", what, *timer_ms),
                   fmt::format("install the udev rule 60-navcal.rules, or for now: echo 1 | sudo tee "
                               "/sys/bus/usb-serial/devices/{}/latency_timer",
                               tty));
  }
  return good(topic, what);
}

Account own_account() {
  Account account{std::to_string(::geteuid()), ::geteuid(), {}};
  if (const passwd* entry = ::getpwuid(account.uid)) account.name = entry->pw_name;
  account.groups.resize(static_cast<std::size_t>(std::max(::getgroups(0, nullptr), 0)));
  const int count = ::getgroups(static_cast<int>(account.groups.size()), account.groups.data());
  account.groups.resize(static_cast<std::size_t>(std::max(count, 0)));
  account.groups.push_back(::getegid());
  return account;
}

Account service_account() {
  if (::geteuid() == 0) {
    if (const passwd* entry = ::getpwnam(kServiceUser)) return account_of(*entry);
  }
  return own_account();
}

bool may_read_and_write(const Account& account, uid_t owner, gid_t group, mode_t mode) {
  if (account.uid == 0) return true;
  constexpr mode_t kOwner = S_IRUSR | S_IWUSR, kGroup = S_IRGRP | S_IWGRP, kOthers = S_IROTH | S_IWOTH;
  // The first that applies decides, as in the kernel.
  if (account.uid == owner) return (mode & kOwner) == kOwner;
  const bool member = std::ranges::find(account.groups, group) != account.groups.end();
  return member ? (mode & kGroup) == kGroup : (mode & kOthers) == kOthers;
}

bool may_read_and_write(const Account& account, const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return false;
  return may_read_and_write(account, status.st_uid, status.st_gid, status.st_mode);
}

std::string group_of(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return {};
  const group* entry = ::getgrgid(status.st_gid);
  return entry != nullptr ? entry->gr_name : std::to_string(status.st_gid);
}

}  // namespace navcal::cli

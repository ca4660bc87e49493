// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cli/doctor_checks.h"
#include "ports/finder.h"
#include "ports/holder.h"
#include "ports/sysfs.h"

namespace navcal::cli {
namespace {

std::string mend_of_holder(const std::string& holder, const std::string& device) {
  const std::string tty = std::filesystem::path(device).filename();
  if (holder.starts_with("gpsd")) return "sudo systemctl disable --now gpsd.socket gpsd.service";
  if (holder.starts_with("ModemManager")) return "sudo systemctl disable --now ModemManager.service";
  if (holder.starts_with("agetty")) return "sudo systemctl disable --now serial-getty@" + tty + ".service";
  return "end that program: of two readers of a port each gets only a part of the bytes";
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

}  // namespace navcal::cli

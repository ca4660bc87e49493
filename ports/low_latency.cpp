// SPDX-License-Identifier: Apache-2.0
#include "ports/low_latency.h"

#include <fmt/format.h>
#include <linux/serial.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstring>

namespace navcal::ports {
namespace {

std::string ask_driver(int fd, std::optional<int>& former_flags) {
  serial_struct serial{};
  if (::ioctl(fd, TIOCGSERIAL, &serial) != 0) return "the driver has no low latency mode";
  const int former = serial.flags;
  if ((static_cast<unsigned>(former) & ASYNC_LOW_LATENCY) != 0)
    return "the driver was in low latency mode already";
  serial.flags |= ASYNC_LOW_LATENCY;
  if (::ioctl(fd, TIOCSSERIAL, &serial) != 0) return fmt::format("the driver refused: {}", std::strerror(errno));
  former_flags = former;
  serial_struct now{};
  if (::ioctl(fd, TIOCGSERIAL, &now) == 0 && (static_cast<unsigned>(now.flags) & ASYNC_LOW_LATENCY) != 0)
    return "low latency mode is on";
  return "asked for, but the driver does not confirm it";
}

}  // namespace

LowLatency ask_low_latency(int fd, const SysfsTty& sysfs) {
  LowLatency result;
  result.report = ask_driver(fd, result.former_flags);
  if (const auto before = sysfs.latency_timer_ms()) {
    constexpr int kLeast_ms = 1;
    const bool allowed = *before <= kLeast_ms || sysfs.set_latency_timer_ms(kLeast_ms);
    result.report += fmt::format("; latency timer {} ms{}", sysfs.latency_timer_ms().value_or(*before),
                                 allowed ? "" : " (no permission to set it: see the udev rule)");
  }
  return result;
}

void restore_latency(int fd, const LowLatency& asked) {
  if (!asked.former_flags) return;
  serial_struct serial{};
  if (::ioctl(fd, TIOCGSERIAL, &serial) != 0) return;
  serial.flags = *asked.former_flags;
  ::ioctl(fd, TIOCSSERIAL, &serial);
}

}  // namespace navcal::ports

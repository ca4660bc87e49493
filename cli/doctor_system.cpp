// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/timex.h>

#include "cli/doctor_checks.h"

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

}  // namespace navcal::cli

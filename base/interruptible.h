// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <signal.h>

#include <csignal>
#include <vector>

namespace navcal::base {

/// The signals with which a program ends in good order: Ctrl-C, kill, and its terminal that is closed, unless it
/// was started to outlive that (nohup).
inline std::vector<int> ending_signals() {
  struct sigaction hangup {};
  ::sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler == SIG_IGN) return {SIGINT, SIGTERM};
  return {SIGINT, SIGTERM, SIGHUP};
}

/// Such a signal ends the work at the next step, so that leases are given back and half-written files are removed
/// on the way out. One at a time.
class Interruptible {
 public:
  Interruptible() {
    interrupted_ = 0;
    for (const int signal : ending_signals()) std::signal(signal, [](int) { interrupted_ = 1; });
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  ~Interruptible() {
    for (const int signal : ending_signals()) std::signal(signal, SIG_DFL);
  }
  [[nodiscard]] static bool interrupted() { return interrupted_ != 0; }

 private:
  static inline volatile std::sig_atomic_t interrupted_ = 0;
};

}  // namespace navcal::base

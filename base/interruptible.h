// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

namespace navcal::base {

/// Ctrl-C ends the work at the next step, so that half-written files are removed on the way out. One at a time.
class Interruptible {
 public:
  Interruptible() {
    interrupted_ = 0;
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted_ = 1; });
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  ~Interruptible() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
  }
  [[nodiscard]] static bool interrupted() { return interrupted_ != 0; }

 private:
  static inline volatile std::sig_atomic_t interrupted_ = 0;
};

}  // namespace navcal::base

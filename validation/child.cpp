// SPDX-License-Identifier: Apache-2.0
#include "validation/child.h"

#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interruptible.h"
#include "base/spawn.h"

namespace navcal::validation {
namespace {

using Clock = std::chrono::steady_clock;

class Child {
 public:
  // Debian 12's <sys/pidfd.h> cannot be used from C++: it lacks the extern "C".
  explicit Child(pid_t pid) : pid_(pid), end_(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0))) {
    if (end_ >= 0) return;
    const int error = errno;
    ::kill(-pid_, SIGKILL);
    (void)reap();
    throw std::system_error(error, std::system_category(), "pidfd_open");
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { ::close(end_); }

  /// False when it has not ended by then, or an interruption is heeded and came.
  [[nodiscard]] bool ended_by(Clock::time_point when, bool heed_interruption) const {
    constexpr int kLook_ms = 50;
    for (;;) {
      pollfd waiting{end_, POLLIN, 0};
      if (::poll(&waiting, 1, kLook_ms) > 0) return true;
      if (Clock::now() >= when || (heed_interruption && base::Interruptible::interrupted())) return false;
    }
  }
  void end_group() const {
    constexpr std::chrono::seconds kGrace{2};
    ::kill(-pid_, SIGTERM);
    (void)ended_by(Clock::now() + kGrace, false);
    // Not reaped yet, so that the number of the group is still its own.
    ::kill(-pid_, SIGKILL);
  }
  [[nodiscard]] int reap() const { return base::wait_for(pid_); }

 private:
  pid_t pid_;
  int end_;  ///< readable once it has ended
};

}  // namespace

ChildEnd run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const std::filesystem::path& errors, std::chrono::milliseconds timeout) {
  const auto begin = Clock::now();
  std::vector<std::string> command{program.string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const Child child(base::spawn({.command = command, .errors = errors}));
  ChildEnd end;
  if (!child.ended_by(begin + timeout, true)) {
    end.how = base::Interruptible::interrupted() ? ChildEnd::How::interrupted : ChildEnd::How::timed_out;
    child.end_group();
  }
  const int status = child.reap();
  end.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  if (end.how != ChildEnd::How::exited) return end;
  if (WIFSIGNALED(status)) return {ChildEnd::How::signalled, WTERMSIG(status), end.seconds};
  end.status = WEXITSTATUS(status);
  return end;
}

}  // namespace navcal::validation

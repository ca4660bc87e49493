// SPDX-License-Identifier: Apache-2.0
#include "validation/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interruptible.h"

// Not Boost.Process: version 1 waits with a timeout by forking, version 2 (new in 1.81) needs Boost.Filesystem and
// ends a child that cannot be started by exit(), which writes our buffers a second time.
namespace navcal::validation {
namespace {

using Clock = std::chrono::steady_clock;

void check(int error, const std::string& what) {
  if (error != 0) throw std::system_error(error, std::system_category(), what);
}

class Spawning {
 public:
  explicit Spawning(const std::filesystem::path& errors) {
    check(::posix_spawn_file_actions_init(&files_), "posix_spawn");
    check(::posix_spawnattr_init(&attributes_), "posix_spawn");
    ::posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&files_, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::posix_spawn_file_actions_addclosefrom_np(&files_, STDERR_FILENO + 1);
    // A group of its own: what the program starts ends with it, and a terminal's Ctrl-C is ours to pass on.
    ::posix_spawnattr_setpgroup(&attributes_, 0);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
  }
  Spawning(const Spawning&) = delete;
  Spawning& operator=(const Spawning&) = delete;
  ~Spawning() {
    ::posix_spawn_file_actions_destroy(&files_);
    ::posix_spawnattr_destroy(&attributes_);
  }

  [[nodiscard]] pid_t start(const std::filesystem::path& program, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program.string());
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_t pid = -1;
    check(::posix_spawn(&pid, program.c_str(), &files_, &attributes_, pointers.data(), ::environ),
          program.string());
    return pid;
  }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

class Child {
 public:
  // Debian 12's <sys/pidfd.h> cannot be used from C++: it lacks the extern "C".
  explicit Child(pid_t pid) : pid_(pid), end_(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0))) {
    if (end_ >= 0) return;
    const int error = errno;
    ::kill(-pid_, SIGKILL);
    reap();
    check(error, "pidfd_open");
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
  /// The status of wait().
  int reap() const {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
    return status;
  }

 private:
  pid_t pid_;
  int end_;  ///< readable once it has ended
};

}  // namespace

ChildEnd run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const std::filesystem::path& errors, std::chrono::milliseconds timeout) {
  const auto begin = Clock::now();
  const Child child(Spawning(errors).start(program, arguments));
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

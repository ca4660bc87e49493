// SPDX-License-Identifier: Apache-2.0
#include "base/spawn.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "base/descriptor.h"

// Not Boost.Process: version 1 waits with a timeout by forking, version 2 (new in 1.81) needs Boost.Filesystem and
// ends a child that cannot be started by exit(), which writes our buffers a second time.
namespace navcal::base {
namespace {

constexpr int kSignalled = 128;

/// A file in memory: unlike a pipe it never fills, so nobody has to read while the program runs.
Descriptor memory_file(const char* name) {
  Descriptor file(::memfd_create(name, MFD_CLOEXEC));
  if (!file) throw std::system_error(last_error(), "memfd_create");
  return file;
}

std::string content_of(const Descriptor& file) {
  std::string text;
  std::array<char, 16384> buffer{};
  for (;;) {
    const ssize_t count = ::pread(file.get(), buffer.data(), buffer.size(), static_cast<off_t>(text.size()));
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

pid_t spawn(Program program) {
  std::vector<char*> arguments, environment;
  for (std::string& argument : program.command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  const std::string name = program.variable.substr(0, program.variable.find('=') + 1);
  if (!name.empty()) environment.push_back(program.variable.data());
  for (char** ours = ::environ; *ours != nullptr; ++ours) {
    if (name.empty() || !std::string_view(*ours).starts_with(name)) environment.push_back(*ours);
  }
  environment.push_back(nullptr);
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY;
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, program.output.c_str(), kWrite, 0644);
  ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, program.errors.c_str(), kWrite, 0644);
  ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  if (!program.folder.empty()) ::posix_spawn_file_actions_addchdir_np(&files, program.folder.c_str());
  // A group of its own: what the program starts ends with it, and a terminal's Ctrl-C is ours to pass on.
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t pid = -1;
  const int error = ::posix_spawnp(&pid, arguments[0], &files, &attributes, arguments.data(), environment.data());
  ::posix_spawn_file_actions_destroy(&files);
  ::posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::system_error(error, std::system_category(), program.command.front());
  return pid;
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

CommandOutput run_command(const std::vector<std::string>& command) {
  const Descriptor out = memory_file("out"), err = memory_file("err");
  const auto path_of = [](const Descriptor& file) { return "/proc/self/fd/" + std::to_string(file.get()); };
  pid_t pid = -1;
  try {
    pid = spawn({.command = command, .errors = path_of(err), .output = path_of(out)});
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::no_such_file_or_directory) throw;
    return {kNoSuchProgram, {}, command.front() + ": there is no such program"};
  }
  const int status = wait_for(pid);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status), content_of(out),
          content_of(err)};
}

}  // namespace navcal::base

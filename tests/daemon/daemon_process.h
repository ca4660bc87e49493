// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/daemon/tcp_client.h"
#include "tests/support/free_port.h"
#include "tests/support/temporary_folder.h"

namespace navcal::daemon {

/// An instrument's end of a serial line.
class FakeLine {
 public:
  FakeLine() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) throw std::runtime_error("no pty");
    path_ = ::ptsname(master_);
  }
  ~FakeLine() { ::close(master_); }
  FakeLine(const FakeLine&) = delete;
  FakeLine& operator=(const FakeLine&) = delete;

  void write(std::string_view bytes) const {
    if (::write(master_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("pty is full");
    }
  }
  /// An NMEA sentence: `body` with its dollar, checksum and line end.
  void sentence(std::string_view body) const {
    unsigned char checksum = 0;
    for (const char c : body) checksum ^= static_cast<unsigned char>(c);
    char tail[8];
    std::snprintf(tail, sizeof tail, "*%02X\r\n", checksum);
    write("$" + std::string(body) + tail);
  }
  /// Bytes that the daemon has sent since, waiting up to `limit_ms` for the first.
  [[nodiscard]] std::string read(int limit_ms) const {
    pollfd ready{master_, POLLIN, 0};
    char bytes[256];
    if (::poll(&ready, 1, limit_ms) <= 0) return {};
    const ssize_t n = ::read(master_, bytes, sizeof bytes);
    return n > 0 ? std::string(bytes, static_cast<std::size_t>(n)) : std::string();
  }
  /// Nobody has the other end open.
  [[nodiscard]] bool is_closed() const {
    pollfd ends{master_, 0, 0};
    return ::poll(&ends, 1, 0) > 0 && (ends.revents & POLLHUP) != 0;
  }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int master() const { return master_; }

 private:
  int master_;
  std::string path_;
};

/// A navcald of its own with one NMEA port on a fake line; its folder goes with it.
class DaemonProcess {
 public:
  /// `standard_error`: where its diagnostics go, if not to a file in its folder. `ports`: more of the
  /// configuration.
  explicit DaemonProcess(std::vector<std::string> more = {}, const std::string& standard_error = {},
                         std::string_view ports = {}) {
    const std::string folder = folder_.path();
    std::ofstream(config()) << "[port.compass]\nprotocol = \"nmea\"\npath = \"" << line.path()
                            << "\"\nbaud = 9600\n"
                            << ports;
    port_ = test::free_port();
    arguments_ = {NAVCALD,
                  "--config",
                  config(),
                  "--set",
                  "log.directory=" + folder + "/log",
                  "--set",
                  "control.socket=" + folder + "/control",
                  "--set",
                  "log.free_floor_MB=0",
                  "--set",
                  "status.port=" + std::to_string(port_)};
    arguments_.insert(arguments_.end(), more.begin(), more.end());
    pid_ = spawn(arguments_, standard_error.empty() ? folder + "/stderr" : standard_error);
  }
  ~DaemonProcess() {
    if (pid_ > 0) stop(SIGKILL);
  }
  DaemonProcess(const DaemonProcess&) = delete;
  DaemonProcess& operator=(const DaemonProcess&) = delete;

  /// Waits until it greets a client: then everything else is open, too.
  void wait_until_ready() const {
    for (int i = 0; i < 4000; ++i) {
      try {
        Client client(port_);
        if (client.line()) return;
      } catch (const std::runtime_error&) {
        ::usleep(5000);
      }
    }
    throw std::runtime_error("navcald does not answer: " + diagnostics());
  }

  /// Another daemon with the same settings and more, until it ends by itself; its status and what it said.
  [[nodiscard]] std::pair<int, std::string> run_another(const std::vector<std::string>& more) const {
    auto arguments = arguments_;
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string output = folder_.path().string() + "/another";
    const int status = status_of(spawn(arguments, output));
    return {status, contents(output)};
  }

  /// Its exit status; 256 + signal when it was killed.
  int stop(int signal) {
    ::kill(pid_, signal);
    const pid_t pid = pid_;
    pid_ = 0;
    return status_of(pid);
  }

  /// After stop(): the same daemon again.
  void start_again() { pid_ = spawn(arguments_, folder_.path().string() + "/stderr"); }

  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }
  [[nodiscard]] std::string config() const { return folder_.path().string() + "/navcald.toml"; }
  [[nodiscard]] std::string diagnostics() const { return contents(folder_.path() / "stderr"); }
  [[nodiscard]] std::vector<std::filesystem::path> logs() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "log")) {
      if (entry.path().extension() == ".mcap") files.push_back(entry.path());
    }
    return files;
  }

  FakeLine line;

 private:
  [[nodiscard]] pid_t spawn(const std::vector<std::string>& arguments, const std::string& output) const {
    // A daemon that outlives its test would read the pseudo-terminals of others.
    std::vector<std::string> command{"/usr/bin/env",
                                     "STATE_DIRECTORY=" + folder_.path().string() + "/state",
                                     "/usr/bin/setpriv",
                                     "--pdeathsig",
                                     "KILL",
                                     "--"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (const auto& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, output.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    pid_t pid = 0;
    const int error = posix_spawn(&pid, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error("cannot start " + arguments[0]);
    return pid;
  }
  static int status_of(pid_t pid) {
    int status = 0;
    ::waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 256 + WTERMSIG(status);
  }
  static std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  test::TemporaryFolder folder_;
  std::vector<std::string> arguments_;
  std::uint16_t port_ = 0;
  pid_t pid_ = 0;
};

}  // namespace navcal::daemon

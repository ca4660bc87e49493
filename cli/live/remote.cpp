// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/printable.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/line_socket.h"
#include "cli/live/log_link.h"
#include "cli/live/remote_console.h"
#include "cli/live/remote_operator.h"
#include "cli/live/result_file.h"

namespace navcal::cli {
namespace {

/// Bytes asked for at once: ten seconds on a link of 2 kB/s.
constexpr std::uint64_t kRemotePart_bytes = 12288;
/// Time for which an answer is awaited on a link that may be dead for a while.
constexpr double kRemotePatience_s = 600;

LogLink vehicle_logs(RemoteOperator& remote) {
  return {
      [&](const nlohmann::json& request) { return granted_answer(remote.ask(request.dump(), kRemotePatience_s)); },
      kRemotePart_bytes};
}

void list_files(RemoteOperator& remote) {
  for (const RemoteLog& log : vehicle_logs(remote).list())
    fmt::print("{:>12}  {}\n", log.bytes, base::printable(log.name));
}

/// Also the log that is being written, as far as it is there.
void get_file(RemoteOperator& remote, const std::string& name, const std::filesystem::path& target) {
  expect_new(target);
  LogLink link = vehicle_logs(remote);
  const RemoteLog log = link.wanted({name}).front();
  base::Progress progress("remote get");
  fetch_log(link, log, target, [&](std::uint64_t bytes) {
    progress.show(base::printable(name), static_cast<double>(bytes) / static_cast<double>(log.bytes));
  });
}

using RemoteClock = RemoteOperator::Clock;

struct RemoteCommandOptions {
  RemoteOperator::Options remote;
  std::string action;
  std::string argument;
  std::string output;
  bool json = false;
  double seconds = 0;
  double wait_s = 30;
};

/// Standard input in lines.
class TypedLines {
 public:
  /// The descriptor to wait for; -1 after the end.
  [[nodiscard]] int fd() const { return is_over_ ? -1 : STDIN_FILENO; }
  [[nodiscard]] bool is_over() const { return is_over_; }
  /// Reads what is there. Called only when something is.
  void read() {
    char bytes[512];
    const ssize_t n = ::read(STDIN_FILENO, bytes, sizeof bytes);
    if (n > 0) {
      text_.append(bytes, static_cast<std::size_t>(n));
    } else if (n == 0 || (errno != EINTR && errno != EAGAIN)) {
      is_over_ = true;
    }
  }
  [[nodiscard]] std::optional<std::string> next() {
    const auto end = text_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return line;
  }

 private:
  std::string text_;
  bool is_over_ = false;
};

bool can_be_read(int fd) {
  pollfd readable{fd, POLLIN, 0};
  return fd >= 0 && ::poll(&readable, 1, 0) > 0;
}

/// Throws std::runtime_error when the vehicle was not stopped.
void stop_vehicle(RemoteOperator& remote, double wait_s) {
  remote.stop();
  std::optional<std::string> answer;
  const auto until = RemoteOperator::after(wait_s);
  while (!(answer = remote.take_answer()) && RemoteClock::now() < until && !base::Interruptible::interrupted())
    remote.work(until);
  if (answer != "ok") throw std::runtime_error("NOT stopped: " + answer.value_or("no answer came"));
  fmt::print("stopped: the safe state was ordered, and nobody is in charge\n");
}

/// Takes typed lines until Ctrl-C, quit or the end of the time.
void drive_by_hand(RemoteOperator& remote, const RemoteCommandOptions& options) {
  const auto picture = options.json                   ? RemoteConsole::Picture::json
                       : ::isatty(STDOUT_FILENO) != 0 ? RemoteConsole::Picture::terminal
                                                      : RemoteConsole::Picture::lines;
  RemoteConsole console(remote, picture);
  TypedLines typed;
  const auto end = RemoteOperator::after(options.seconds > 0 ? options.seconds : 1e8);
  bool goes_on = true;
  while (goes_on && RemoteClock::now() < end && !base::Interruptible::interrupted() && std::ferror(stdout) == 0) {
    // Commands that arrive before there is a session wait for it.
    const bool may_type = remote.host().has_session();
    remote.work(end, may_type ? typed.fd() : -1);
    console.show();
    if (!may_type || !can_be_read(typed.fd())) continue;
    typed.read();
    while (goes_on) {
      const auto line = typed.next();
      if (!line) break;
      goes_on = console.take(*line);
    }
    // Nobody can type any more: nobody is in charge.
    if (typed.is_over() && remote.is_in_charge()) remote.release();
  }
  remote.end();
  console.show();
}

void run_remote(const RemoteCommandOptions& options) {
  const base::Interruptible interruptible;
  std::signal(SIGPIPE, SIG_IGN);
  RemoteOperator remote(options.remote);
  if (options.action.empty()) return drive_by_hand(remote, options);
  remote.wait_for_session(options.wait_s);
  if (options.action == "ls") {
    list_files(remote);
  } else if (options.action == "get") {
    get_file(remote, options.argument, options.output.empty() ? options.argument : options.output);
  } else if (options.action == "stop") {
    stop_vehicle(remote, options.wait_s);
  } else {
    const std::string line = options.action == "status" ? R"({"command":"status"})" : options.argument;
    fmt::print("{}\n", base::printable(remote.ask(line, options.wait_s), "\n"));
  }
  remote.end();
}

void add_line_options(CLI::App* command, RemoteCommandOptions& options) {
  add_valued(command, "--baud", "BAUD [57600]", options.remote.baud)->check(CLI::Range(300, 4000000));
  add_valued(command, "--key-file", "FILE", options.remote.key_file);
  add_valued(command, "--budget", "B/S [2000]", options.remote.budget_B_s)->check(CLI::Range(300.0, 1e6));
  add_valued(command, "--wait", "SECONDS [30]", options.wait_s)->check(CLI::Range(0.1, 86400.0));
}

}  // namespace

void add_remote(CLI::App& app) {
  auto* command = app.add_subcommand("remote", "watches and steers a vehicle over a modem or TCP");
  const auto options = std::make_shared<RemoteCommandOptions>();
  add_valued(command, "port", "PORT", options->remote.address)->required();
  auto* const action = add_valued(command, "action", "[status|stop|send|ls|get]", options->action)
                           ->check(CLI::IsMember({"status", "stop", "send", "ls", "get"}));
  add_valued(command, "argument", "[JSON|NAME]", options->argument)->needs(action);
  add_valued(command, "-o,--output", "FILE [NAME]", options->output);
  add_line_options(command, *options);
  add_valued(command, "--holder", "NAME [operator]", options->remote.holder);
  add_valued(command, "--priority", "NUMBER [10]", options->remote.priority)->check(CLI::Range(0, 1000));
  add_valued(command, "--lease-timeout", "SECONDS [5]", options->remote.lease_timeout_s)
      ->check(CLI::Range(0.1, 60.0));
  command->add_flag("--json", options->json);
  add_valued(command, "--seconds", "SECONDS [0]", options->seconds)->check(CLI::NonNegativeNumber);
  command->callback([options] {
    const bool needs_argument = options->action == "send" || options->action == "get";
    if (needs_argument == options->argument.empty())
      throw base::Failure(base::Exit::usage, needs_argument ? options->action + " needs an argument"
                                                            : options->action + " takes no argument");
    run_remote(*options);
  });
}

}  // namespace navcal::cli

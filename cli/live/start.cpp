// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>

#include "base/interruptible.h"
#include "base/spawn.h"
#include "base/temporary_folder.h"
#include "cli/live/commands.h"
#include "cli/live/doctor_checks.h"
#include "cli/live/option_kinds.h"
#include "cli/live/result_file.h"
#include "cli/live/start_plan.h"
#include "cli/live/watch_stream.h"
#include "config/complaints.h"
#include "config/load.h"
#include "ports/finder.h"
#include "ports/holder.h"

namespace navcal::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct StartCommandOptions {
  StartRequest request;
  double seconds = 10;
};

[[noreturn]] void fail_start(const std::string& why) { throw base::Failure(base::Exit::failed, "start: " + why); }

/// Path of another program of navcal: beside this one, or in its room of the build folder; empty: it is not there.
std::string find_program(const std::string& name) {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (const char* const room : {".", "../daemon", "../web", "../ros2"}) {
    std::string program = (folder / room / name).lexically_normal();
    if (::access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

std::string needed_program(const std::string& name) {
  std::string program = find_program(name);
  if (program.empty()) fail_start(name + " is not installed beside navcal (docs/install.md)");
  return program;
}

/// A program in a process of its own, asked to end when this object or this process goes. What it prints goes to
/// standard error.
class OwnProgram {
 public:
  explicit OwnProgram(std::vector<std::string> command) {
    std::vector<char*> arguments;
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ < 0) throw std::system_error(errno, std::system_category(), command.front());
    if (pid_ > 0) return;
    // A group of its own: a terminal's Ctrl-C is passed on once, since the second signal ends navcald at once.
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  OwnProgram(const OwnProgram&) = delete;
  OwnProgram& operator=(const OwnProgram&) = delete;
  ~OwnProgram() { stop(); }

  /// Exit status, 128 + number of the signal that ended it; nullopt while it runs.
  std::optional<int> ended() {
    int status = 0;
    if (!status_ && ::waitpid(pid_, &status, WNOHANG) == pid_)
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return status_;
  }
  /// Sends SIGTERM once, and SIGKILL after 25 s: systemd gives navcald 20 s to finish its log.
  int stop() {
    if (!ended()) ::kill(pid_, SIGTERM);
    for (const auto until = Clock::now() + std::chrono::seconds(25); !ended(); ::poll(nullptr, 0, 20)) {
      if (Clock::now() > until) ::kill(pid_, SIGKILL);
    }
    return *status_;
  }

 private:
  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// A file that is there is kept: the same is used again, another is refused.
void write_configuration(const StartPlan& plan) {
  const std::string file = plan.configuration.string();
  const bool is_there = std::filesystem::exists(std::filesystem::symlink_status(file));
  if (is_there && config::content_of(file) != plan.toml)
    fail_start(
        fmt::format("{}: the file is there with other content and is not written over. `navcald --config {}` runs "
                    "it as it is; --output FILE writes another one",
                    file, file));
  if (!plan.is_service) std::filesystem::create_directories(plan.configuration.parent_path());
  if (!is_there) write_new(file, plan.toml);
  print_answer(fmt::format("configuration: {}{}\n", file, is_there ? ", of an earlier start" : ""));
}

/// The words of `navcald --check`, and the obstacles that `navcal doctor` would name. Throws Failure at such a
/// one.
void check_configuration(const std::string& navcald, const std::string& file) {
  const auto checked = base::run_command({navcald, "--config", file, "--check"});
  if (checked.status != 0) throw base::Failure(base::Exit::bad_input, checked.err);
  print_answer(checked.out + "\n");
  const config::Settings settings = config::load(file);
  Findings findings{check_status_port(settings.status)};
  if (findings[0].severity == Finding::Severity::good && !is_free(settings.status.port))
    findings[0] = fault(findings[0].topic, findings[0].found,
                        "`navcal watch` shows what runs there; --port N runs another navcald beside it");
  for (const auto& port : settings.ports) {
    findings.push_back(check_port(port, own_account()));
    std::string why;
    const auto found = port.address.empty() ? ports::find_port(port, why) : std::nullopt;
    const std::string holders = found ? ports::visible_holders_of(found->path) : "";
    if (!holders.empty())  // another navcald, too
      findings.back() =
          fault("port " + port.name, found->path + " is held by " + holders, "end that program first");
  }
  if (count_of(findings, Finding::Severity::fault) == 0) return;
  print_answer(doctor_text(findings));
  fail_start("nothing was started; the configuration is kept");
}

void expect_running(OwnProgram& daemon) {
  if (const auto status = daemon.ended())
    fail_start(fmt::format("navcald ended by itself with status {}; its words stand above", *status));
}

/// Listens for some seconds to what the daemon delivers, and says it.
void listen(const StartPlan& plan, OwnProgram& daemon, const StartCommandOptions& options) {
  WatchStream stream("127.0.0.1", std::to_string(options.request.status_port), Arrivals::kRequest);
  Arrivals arrivals(plan.port);
  print_answer(fmt::format("listening for {} s ...\n\n", options.seconds));
  std::optional<Clock::time_point> begin;  // the first word of the daemon
  std::chrono::duration<double> passed{0};
  while (passed.count() < options.seconds) {
    const auto line = stream.next(Clock::now() + std::chrono::milliseconds(100));
    if (base::Interruptible::interrupted()) return;
    expect_running(daemon);
    if (line) arrivals.take(*line);
    if (line && !begin) begin = Clock::now();
    if (begin) passed = Clock::now() - *begin;
  }
  print_answer(arrivals.came() + "\n" + arrivals.missing(plan.expected, plan.silent));
}

std::vector<std::string> ros2_command(const StartRequest& request, const std::string& samples) {
  std::vector<std::string> command{needed_program("navcal-ros2"), "--samples", samples, "--status",
                                   fmt::format("127.0.0.1:{}", request.status_port)};
  const std::vector<std::string> usual{"imu=/imu/data", "mag=/imu/mag", "fix=/fix"};
  for (const std::string& topic : request.topics.empty() ? usual : request.topics) {
    command.emplace_back("--in");
    command.push_back(topic);
  }
  return command;
}

/// How the installed service is started with a configuration that was tried.
std::string service_lines(const StartPlan& plan, const StartRequest& request) {
  std::string lines = "navcald ran for this trial only. The service is started by\n";
  if (plan.samples.empty() && plan.toml.find("\naddress") != std::string::npos)
    lines +=
        "  sudo install -D -t /etc/systemd/system/navcald.service.d /usr/share/navcal/navcald-network.conf\n"
        "  sudo systemctl daemon-reload\n";
  lines += "  sudo systemctl enable --now navcald.socket navcald navcal-web.socket navcal-web\n";
  if (plan.samples.empty()) return lines;
  const auto command = ros2_command(request, plan.samples);
  return lines +
         fmt::format(
             "  OPTIONS=\"{}\" in /etc/navcal/ros2.conf, then\n  sudo systemctl enable --now navcal-ros2\n",
             fmt::join(command.begin() + 1, command.end(), " "));
}

void start(const StartCommandOptions& options) {
  const base::Interruptible interruptible;
  const StartPlan plan = start_plan(options.request);
  std::vector<std::string> navcald{needed_program("navcald"), "--config", plan.configuration.string()};
  std::string samples = plan.samples;
  if (!samples.empty()) (void)needed_program("navcal-ros2");
  write_configuration(plan);
  check_configuration(navcald[0], plan.configuration);

  std::optional<base::TemporaryFolder> trial;  // in the place of the service's folders
  if (plan.is_service) {
    const std::string folder = trial.emplace().path();
    navcald.insert(navcald.end(), {"--set", "log.enabled=false", "--set", "log.directory=" + folder, "--set",
                                   "control.socket=" + folder + "/control"});
    if (!samples.empty()) {
      samples = folder + "/samples";
      navcald.insert(navcald.end(), {"--set", "port.ros.address=unix-listen:" + samples});
    }
  }
  OwnProgram daemon(navcald);
  std::optional<OwnProgram> web, ros2;
  if (!samples.empty()) ros2.emplace(ros2_command(options.request, samples));
  listen(plan, daemon, options);
  std::uint16_t page = 8765;
  if (plan.is_service && !base::Interruptible::interrupted())
    return print_answer(service_lines(plan, options.request) + fmt::format("page: http://127.0.0.1:{}/\n", page));
  while (!is_free(page)) ++page;
  const std::string folder = plan.configuration.parent_path();
  const std::string program = find_program("navcal-web"), status = std::to_string(options.request.status_port);
  if (!program.empty() && !base::Interruptible::interrupted()) {
    web.emplace(std::vector<std::string>{program, "--port", std::to_string(page), "--status",
                                         "127.0.0.1:" + status, "--control", folder + "/control"});
    print_answer(fmt::format(
        "page: http://127.0.0.1:{}/\nlook: navcal watch --port {}\nlog: {}/log\nnavcald runs until Ctrl-C\n", page,
        status, folder));
  }
  for (constexpr int kLook_ms = 200; !base::Interruptible::interrupted(); ::poll(nullptr, 0, kLook_ms))
    expect_running(daemon);
  web.reset();
  ros2.reset();
  // A signal that comes before navcald catches it ends it, too.
  if (const int ended = daemon.stop(); ended != 0 && ended != 128 + SIGTERM)
    fail_start(fmt::format("navcald stopped with status {}", ended));
  print_answer("navcald has stopped in good order\n");
}

}  // namespace

void add_start(CLI::App& app) {
  const auto [command, options] = add_command<StartCommandOptions>(
      app, "start", "configures, checks and runs navcald for a common vehicle or device", start);
  StartRequest& request = options->request;
  add_valued(command, "--for", "bluerov2|ros2|gpsd|nmea", request.kind)
      ->check(CLI::IsMember(std::vector<std::string>{"bluerov2", "ros2", "gpsd", "nmea"}))
      ->required();
  add_valued(command, "--output", "FILE [navcal-KIND/navcald.toml]", request.output);
  add_valued(command, "--address", "ADDRESS [bluerov2: udp:0.0.0.0:14551]", request.address);
  add_valued(command, "--device", "PATH [gpsd, nmea: the only one there]", request.device);
  add_valued(command, "--baud", "BAUD [bluerov2 115200, gpsd 9600, nmea 4800]", request.baud)
      ->check(CLI::Range(50, 4000000));
  add_repeatable(command, "--in", "KIND=/TOPIC [imu=/imu/data mag=/imu/mag fix=/fix]", request.topics)->take_all();
  add_number(command, "--port", 1, 65535, request.status_port);
  add_number(command, "--seconds", 1.0, 3600.0, options->seconds);
}

}  // namespace navcal::cli

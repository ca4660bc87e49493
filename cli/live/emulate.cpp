// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/this_coro.hpp>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>

#include "base/interruptible.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "cli/live/shared_options.h"
#include "config/load.h"
#include "config/mission_file.h"
#include "devices/instrument_model.h"
#include "emulation/emulate_session.h"
#include "ports/no_throw.h"
#include "protocols/device_types.h"
#include "sim/instruments/emulators.h"
#include "sim/path.h"
#include "sim/vehicle/body.h"
#include "sim/vehicle/helm.h"

namespace navcal::cli {
namespace {

inline constexpr std::string_view kConsoleHelp =
    "unplug PORT | replug PORT | power-cycle PORT | stall PORT SECONDS | noise PROB [PORT] | drop PROB [PORT] | "
    "imu-status BITS | quit";

std::string set_probability(emulation::EmulateSession& session, std::istringstream& words,
                            void (emulation::Misbehaviour::*setter)(double)) {
  double probability = 0;
  if (!(words >> probability) || probability < 0 || probability > 1) return "a probability from 0 to 1 is missing";
  std::string name;
  if (words >> name) {
    emulation::EmulatedPort* port = session.find(name);
    if (port == nullptr) return fmt::format("there is no port {}", name);
    (port->misbehaviour().*setter)(probability);
    return {};
  }
  for (const auto& port : session.ports()) (port->misbehaviour().*setter)(probability);
  return {};
}

std::string act_on_port(emulation::EmulateSession& session, const std::string& verb, std::istringstream& words) {
  std::string name;
  words >> name;
  emulation::EmulatedPort* port = session.find(name);
  if (port == nullptr) return fmt::format("there is no port {}", name.empty() ? "named" : name);
  if (verb == "unplug") {
    port->unplug();
  } else if (verb == "replug") {
    port->replug();
  } else if (verb == "power-cycle") {
    port->power_cycle();
  } else {
    double seconds = 0;
    if (!(words >> seconds) || seconds <= 0) return "the number of seconds is missing";
    port->stall(seconds);
  }
  return {};
}

/// One line of what people (or a test) type at a running emulator. Empty when it was done, else why not.
std::string obey_line(emulation::EmulateSession& session, std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string verb;
  if (!(words >> verb)) return {};
  if (verb == "unplug" || verb == "replug" || verb == "power-cycle" || verb == "stall") {
    return act_on_port(session, verb, words);
  }
  if (verb == "noise") return set_probability(session, words, &emulation::Misbehaviour::set_noise);
  if (verb == "drop") return set_probability(session, words, &emulation::Misbehaviour::set_drop);
  if (verb == "imu-status") {
    unsigned bits = 0;
    if (!(words >> bits) || bits > 15)
      return "bits from 0 to 15: 1 leak forward, 2 leak aft, 4 over range, 8 low supply";
    const bool is_set = session.set_imu_status(static_cast<std::uint8_t>(bits));
    return is_set ? "" : "no inertial card is emulated";
  }
  if (verb == "quit") {
    session.stop();
    return {};
  }
  return fmt::format("'{}' is none of: {}", verb, kConsoleHelp);
}

namespace asio = boost::asio;
constexpr std::size_t kLongestLine = 1024;

bool in_the_background(int fd) { return ::isatty(fd) != 0 && ::tcgetpgrp(fd) != ::getpgrp(); }

/// Hands on each line that comes in on a descriptor, to the end of it; nothing at all when it cannot be waited for
/// (a file, /dev/null). Leaves a terminal alone while it belongs to another program: reading would stop this one.
asio::awaitable<void> read_lines(int fd, std::function<void(std::string_view)> on_line) {
  const auto executor = co_await asio::this_coro::executor;
  asio::steady_timer timer(executor);
  asio::posix::stream_descriptor input(executor);
  boost::system::error_code error;
  input.assign(::dup(fd), error);
  std::string held;
  while (!error) {
    const auto [failed] = co_await input.async_wait(asio::posix::stream_descriptor::wait_read, ports::kNoThrow);
    if (failed) break;
    if (in_the_background(fd)) {
      timer.expires_after(std::chrono::seconds(1));
      co_await timer.async_wait(ports::kNoThrow);
      continue;
    }
    // Read after the wait, not by Asio, which would make the shell's own descriptor non-blocking.
    std::array<char, 256> buffer{};
    const ssize_t n = ::read(input.native_handle(), buffer.data(), buffer.size());
    if (n <= 0) break;
    held.append(buffer.data(), static_cast<std::size_t>(n));
    for (auto end = held.find('\n'); end != std::string::npos; end = held.find('\n')) {
      on_line(std::string_view(held).substr(0, end));
      held.erase(0, end + 1);
    }
    if (held.size() > kLongestLine) held.clear();
  }
}

void run(const emulation::EmulateArguments& arguments) {
  asio::io_context io{1};
  emulation::EmulateSession session(io, arguments);
  asio::signal_set signals(io);
  for (const int signal : base::ending_signals()) signals.add(signal);
  signals.async_wait([&](const boost::system::error_code& error, int) {
    if (!error) io.stop();
  });
  asio::co_spawn(io,
                 read_lines(STDIN_FILENO,
                            [&](std::string_view line) {
                              const std::string why = obey_line(session, line);
                              if (!why.empty()) fmt::print(stderr, "navcal emulate: {}\n", why);
                            }),
                 asio::detached);
  fmt::print("ready\n");
  std::fflush(stdout);
  try {
    io.run();
    session.finish();
  } catch (const std::runtime_error&) {
    session.finish_after_error();
    throw;
  }
  session.report();
}

template <class Plan>
void add_plans(CLI::App* command, const std::string& name, std::vector<Plan>& plans,
               std::optional<Plan> (*parse)(std::string_view), const std::string& help) {
  command->add_option_function<std::vector<std::string>>(
      name,
      [&plans, parse, name](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
          const auto plan = parse(text);
          if (!plan) throw CLI::ValidationError(name, "cannot be read: " + text);
          plans.push_back(*plan);
        }
      },
      help);
}

void add_vehicle(CLI::App* command, emulation::EmulateArguments& arguments) {
  command
      ->add_option_function<std::vector<std::string>>(
          "--vehicle",
          [&arguments](const std::vector<std::string>& file) {
            if (!file.empty()) arguments.vehicle = file.front();
          },
          "without --mission: the motor card's orders drive a simulated vehicle, which lies still at the\n"
          "surface at first (navcal pilot); with it, the vehicle that does the mission. Without a file:\n"
          "the reference vehicle. A layout obeys the lines $PNCAO at DIR/outputs instead of a motor card")
      ->expected(0, 1)
      ->option_text("[FILE.toml]");
  add_valued(command, "--battery", "AH", arguments.battery_Ah)->check(CLI::Range(0.0, 3.7));
  CLI::Option* const floor =
      add_valued(command, "--floor-depth", "METRES", arguments.floor_depth_m)->check(CLI::Range(0.0, 11000.0));
  add_valued(command, "--floor-slope", "NORTH EAST [0 0]", arguments.floor_slope)
      ->expected(2)
      ->check(CLI::Range(-10.0, 10.0))
      ->needs(floor);
  add_valued(command, "--truth", "FILE.csv", arguments.truth);
}

void add_departures(CLI::App* command, emulation::EmulateArguments& arguments) {
  add_effect_options(command, arguments.effects, arguments.effects_file);
  add_valued(command, "--config", "FILE.toml", arguments.config);
  command->add_flag("--no-noise", arguments.no_noise);
}

void add_misbehaviour(CLI::App* command, emulation::EmulateArguments& arguments) {
  const auto* const misbehaviour = "Misbehaviour";
  command->add_option("--noise", arguments.noise)->check(CLI::Range(0.0, 1.0))->group(misbehaviour);
  command->add_option("--drop", arguments.drop)->check(CLI::Range(0.0, 1.0))->group(misbehaviour);
  add_plans(command, "--stall", arguments.stalls, &emulation::parse_stall,
            "SECONDS@EVERY: all bytes are held back for SECONDS and then delivered at once, repeated every EVERY "
            "seconds");
  add_plans(command, "--unplug", arguments.unplugs, &emulation::parse_unplug,
            "PORT@T+DURATION: the port is unplugged at T seconds for DURATION seconds; repeatable");
  command->get_option("--stall")->group(misbehaviour);
  command->get_option("--unplug")->group(misbehaviour);
}

std::string mission_names() {
  std::vector<std::string_view> names;
  for (const auto& mission : config::shipped_missions()) names.push_back(mission.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string protocol_names() {
  std::vector<std::string_view> names;
  for (const auto& device : protocols::kDeviceTypes) {
    if (sim::has_emulator(device.protocol)) names.push_back(device.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void add_emulate(CLI::App& app) {
  auto* command = app.add_subcommand("emulate", "live emulated instruments on DIR/compass, imu, gps, motor");
  const auto arguments = std::make_shared<emulation::EmulateArguments>();
  const std::map<std::string, sim::Oncore::Kind> receivers{{"ha", sim::Oncore::Kind::twelve_channels},
                                                           {"ea", sim::Oncore::Kind::eight_channels},
                                                           {"nmea", sim::Oncore::Kind::nmea}};
  command->add_option("--dir", arguments->dir)->required();
  command->add_option("--path", arguments->path);
  command
      ->add_option("--mission", arguments->mission,
                   "an autopiloted mission, repeated at its end: " + mission_names() + ", or a TOML file")
      ->excludes(command->get_option("--path"));
  add_vehicle(command, *arguments);
  add_departures(command, *arguments);
  command->add_option("--seconds", arguments->seconds)->check(CLI::Range(0.0, 1e9));
  add_defaulted(command, "--seed", arguments->seed);
  add_valued(command, "--gps", "ea|ha|nmea", arguments->gps)
      ->transform(
          CLI::CheckedTransformer(receivers));  // the library would print the enumeration's values, as characters
  add_plans(command, "--device", arguments->devices, &emulation::parse_emulated_device,
            "PORT=PROTOCOL: a device of this protocol, as delivered, at DIR/PORT, in the place of the vehicle's\n"
            "own or beside them: " +
                protocol_names() + "; repeatable");
  add_defaulted(command, "--compass-baud", arguments->compass_baud);
  command->add_option("--imu-ppm", arguments->imu_ppm)->check(CLI::Range(-1e4, 1e4));
  add_clock_option(command, arguments->clocks);
  add_place_and_field(command, arguments->where);
  add_valued(command, "--date", "YYYY-MM-DD", arguments->where.date);
  command->add_option("--sent-log", arguments->sent_log);
  add_misbehaviour(command, *arguments);
  command->footer(
      fmt::format("The instruments answer commands and send at the rate of their lines; unread bytes are lost. "
                  "`ready` is printed\n"
                  "when the ports can be opened. Commands on standard input:\n  {}\n\n"
                  "Example: navcal emulate --dir /tmp/ports --noise 0.01 --unplug compass@20+3",
                  kConsoleHelp));
  command->callback([arguments, vehicle = command->get_option("--vehicle")] {
    if (!arguments->path.empty() && vehicle->count() > 0) {
      throw base::Failure(base::Exit::usage, "--path says how the vehicle moves, without --vehicle");
    }
    arguments->ordered = vehicle->count() > 0 && arguments->mission.empty();
    if (vehicle->count() > 0 && !arguments->ordered && arguments->vehicle.empty()) {
      throw base::Failure(base::Exit::usage, "--vehicle: of a mission it needs a file");
    }
    expect_results(
        {arguments->path, arguments->mission, arguments->vehicle, arguments->effects_file, arguments->config},
        {arguments->truth, arguments->sent_log});
    if (!arguments->config.empty())
      arguments->instruments = devices::instrument_model(config::load(arguments->config));
    run(*arguments);
  });
}

}  // namespace navcal::cli

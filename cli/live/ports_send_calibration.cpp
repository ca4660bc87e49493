// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/printable.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "config/complaints.h"
#include "config/network_address.h"
#include "ports/port.h"
#include "protocols/mavlink.h"

namespace navcal::cli {
namespace {

namespace mavlink = protocols::mavlink;
using base::Exit, base::Failure, base::Interruptible, mavlink::Parameter, std::chrono::milliseconds;

struct SendCalibrationOptions {
  std::string link, parameters;
  int baud = 115'200;
  bool yes = false;
};

[[noreturn]] void refuse_to_write(const std::string& why) {
  throw Failure(Exit::failed, why + "; nothing was written");
}

config::PortSettings port_of_link(const SendCalibrationOptions& options) {
  const bool is_device = options.link.starts_with('/');
  if (!is_device && !config::parse_network_address(options.link))
    throw Failure(Exit::usage, options.link + ": is no udp:, tcp: or tcp-listen:ADDRESS:PORT and no device");
  config::PortSettings port;
  (is_device ? port.path : port.address) = options.link;
  port.baud = options.baud;
  return port;
}

/// A link on which we are a ground station, to the first autopilot that is heard. Each call serves the link until
/// it has its answer. Throws Failure when a signal ends that.
class AutopilotLink : private ports::PortListener {
 public:
  explicit AutopilotLink(const SendCalibrationOptions& options)
      : name_(options.link), port_(io_.get_executor(), port_of_link(options), *this) {
    port_.start();
  }

  /// For one that comes from now on. Throws Failure when there is none, and where the vehicle is armed.
  void await_disarmed_heartbeat() {
    const unsigned before = heartbeats_;
    const bool is_there = serve_until(std::chrono::seconds(10), [&] { return heartbeats_ != before; });
    if (is_armed_) refuse_to_write(vehicle() + " is armed");
    if (!is_there) refuse_to_write(fmt::format("{}: no heartbeat of an autopilot within 10 s {}", name_, lost_));
  }
  [[nodiscard]] bool is_armed() const { return is_armed_; }
  [[nodiscard]] std::string vehicle() const {
    return fmt::format("{}, system {}", is_px4() ? "PX4" : "the autopilot", vehicle_);
  }
  /// Nullopt: no answer, as to a name that the autopilot does not know.
  std::optional<Parameter> read(const std::string& name) {
    return ask(mavlink::encode_reading(sender(), vehicle_, name), name);
  }
  /// What is there afterwards, as it was read back.
  std::optional<Parameter> write(const Parameter& wanted) {
    (void)ask(mavlink::encode_setting(sender(), vehicle_, wanted, is_px4()), wanted.name, wanted.value);
    return read(wanted.name);
  }
  /// False when `done` does not hold within the limit.
  template <class Done>
  bool serve_until(milliseconds limit, Done done) {
    constexpr std::uint8_t kGroundStation = 6;
    const auto end = Clock::now() + limit;
    for (; !done(); io_.run_one_for(milliseconds(20))) {
      if (Interruptible::interrupted()) refuse_to_write("interrupted");
      if (Clock::now() >= end) return false;
      if (Clock::now() < heartbeat_due_) continue;
      heartbeat_due_ = Clock::now() + std::chrono::seconds(1);
      port_.send(mavlink::encode_heartbeat(sender(), kGroundStation));
    }
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// The answer to a frame, which is sent again until one comes, or one of this value: others may be for others.
  std::optional<Parameter> ask(const std::vector<std::uint8_t>& frame, const std::string& name,
                               std::optional<double> value = {}) {
    constexpr int kAttempts = 8;
    values_.erase(name);
    const auto is_answered = [&] {
      return values_.contains(name) && values_[name].value == value.value_or(values_[name].value);
    };
    for (int i = 0; i < kAttempts && !(value && is_armed_); ++i) {
      port_.send(frame);
      if (serve_until(milliseconds(400), is_answered)) return values_[name];
    }
    return std::nullopt;
  }
  void on_bytes(std::int64_t /*arrival_ns*/, protocols::Bytes bytes) override {
    parser_.feed(bytes, [this](const protocols::Frame& frame) {
      const mavlink::Message message = mavlink::find_message(frame.bytes).message;
      const mavlink::Payload payload(message.payload);
      if (message.component != mavlink::kAutopilot || (heartbeats_ > 0 && message.system != vehicle_)) return;
      if (message.id == 22) values_[payload.text(8, 16)] = mavlink::parameter_of(message, is_px4());
      if (message.id != 0 || payload.at<std::uint8_t>(5) == mavlink::kNoAutopilot) return;
      vehicle_ = message.system;
      autopilot_ = payload.at<std::uint8_t>(5);
      is_armed_ = (payload.at<std::uint8_t>(6) & 0x80U) != 0;
      ++heartbeats_;
    });
  }
  void on_opened(std::int64_t /*now_ns*/, const ports::OpenPort& /*port*/) override { lost_.clear(); }
  void on_sent(std::int64_t /*now_ns*/, protocols::Bytes /*bytes*/) override {}
  void on_lost(std::int64_t /*now_ns*/, std::string_view reason) override { lost_ = reason; }
  [[nodiscard]] bool is_px4() const { return autopilot_ == 12; }
  mavlink::Sender sender() { return {255, 25, sequence_++}; }

  std::string name_, lost_;  ///< of the link, and why it is not open
  boost::asio::io_context io_{1};
  ports::Port port_;
  mavlink::Parser parser_;
  std::uint8_t vehicle_ = 0, autopilot_ = 0, sequence_ = 0;
  bool is_armed_ = false;
  unsigned heartbeats_ = 0;
  std::map<std::string, Parameter> values_;  ///< the newest of each
  Clock::time_point heartbeat_due_;
};

struct ParameterChange {
  Parameter before, wanted;
};

/// "NAME,VALUE", or QGroundControl's columns: vehicle, component, name, value, type. Shows the comments.
std::vector<Parameter> read_parameters(const std::string& file) {
  std::vector<Parameter> values;
  std::istringstream lines(config::content_of(file));
  for (std::string line, skipped; std::getline(lines, line);) {
    const bool has_columns = line.find('\t') != std::string::npos;
    if (!line.starts_with('#')) std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Parameter value;
    if (line.starts_with('#')) fmt::print("{}\n", base::printable(line));
    if (has_columns) words >> skipped >> skipped;
    if (line.starts_with('#') || !(words >> value.name)) continue;
    if (!(words >> value.value) || (!has_columns && words >> skipped) ||
        (!value.name.starts_with("COMPASS_") && !value.name.starts_with("CAL_MAG")))
      throw Failure(Exit::bad_input, fmt::format("{}: is no value of a compass (COMPASS_..., CAL_MAG...): {}",
                                                 file, base::printable(line)));
    values.push_back(value);
  }
  return values;
}

/// The values in the types that the autopilot states, beside what it has. Throws Failure where they do not fit it.
std::vector<ParameterChange> changes_of(AutopilotLink& link, const std::vector<Parameter>& values) {
  std::vector<ParameterChange> changes;
  std::string missing;
  for (const Parameter& value : values) {
    const auto before = link.read(value.name);
    if (!before) missing += ' ' + value.name;
    if (!before && changes.empty()) break;  // perhaps it answers to nothing
    if (!before) continue;
    const bool is_float = before->type >= Parameter::kFloat;
    const double there = is_float ? double{static_cast<float>(value.value)} : std::round(value.value);
    changes.push_back({*before, {value.name, before->type, there}});
  }
  if (!missing.empty()) refuse_to_write(link.vehicle() + " does not have, or does not tell:" + missing);
  // ArduPilot leaves a diagonal out while all of it is 0. A part of it alone would take an axis away.
  const auto is_zero = [](const ParameterChange& change) {
    return change.before.value == 0 && change.wanted.name.find("_DIA") != std::string::npos;
  };
  if (std::ranges::count_if(changes, is_zero) % 3 != 0)
    refuse_to_write("COMPASS_DIA is 0, and would be written in part: set it to 1");
  return changes;
}

/// Asks while the link is served.
bool is_confirmed(AutopilotLink& link) {
  if (::isatty(STDIN_FILENO) == 0)
    throw Failure(Exit::usage, "no terminal to ask at (--yes writes without); nothing was written");
  fmt::print("Write this to {}? [y/N] ", link.vehicle());
  std::fflush(stdout);
  pollfd input{STDIN_FILENO, POLLIN, 0};
  std::string answer;
  if (link.serve_until(std::chrono::hours(24), [&] { return ::poll(&input, 1, 0) > 0; }))
    std::getline(std::cin, answer);
  return answer == "y" || answer == "Y";
}

/// Says of each value what became of it. Throws Failure unless all were taken.
void write_changes(AutopilotLink& link, const std::vector<ParameterChange>& changes) {
  std::size_t taken = 0;
  std::string why;
  for (const auto& [before, wanted] : changes) {
    if (why.empty() && link.is_armed()) why = ": the vehicle is armed";
    const bool is_sent = why.empty();
    std::optional<Parameter> there;
    try {
      if (is_sent && !(there = link.write(wanted))) why = ": there is no answer";
    } catch (const Failure&) {
      why = ": interrupted";
    }
    const bool is_taken = there && there->value == wanted.value;
    taken += is_taken ? 1 : 0;
    fmt::print("{:<16} {}\n", wanted.name,
               is_taken  ? "taken"
               : there   ? fmt::format("not taken: it is {:.7g}", there->value)
               : is_sent ? "sent; it may have been taken or not"
                         : "not sent");
  }
  if (taken != changes.size())
    throw Failure(Exit::failed, fmt::format("{} of {} values were taken{}", taken, changes.size(), why));
}

void send_calibration(const SendCalibrationOptions& options) {
  const std::vector<Parameter> values = read_parameters(options.parameters);
  const Interruptible interruptible;
  AutopilotLink link(options);
  link.await_disarmed_heartbeat();
  auto changes = changes_of(link, values);
  fmt::print("{}, not armed:\n", link.vehicle());
  std::string former;
  for (const auto& [before, wanted] : changes) {
    fmt::print("{:<16} {:>14.7g} -> {:.7g}\n", wanted.name, before.value, wanted.value);
    former += fmt::format("{},{:.9g}\n", before.name, before.value);
  }
  std::erase_if(changes, [](const ParameterChange& change) { return change.before.value == change.wanted.value; });
  if (changes.empty()) return fmt::print("It has these values.\n");
  if (!options.yes && !is_confirmed(link)) refuse_to_write("not confirmed");
  link.await_disarmed_heartbeat();
  const std::string undo = fmt::format("before-{:%Y%m%dT%H%M%SZ}.param", fmt::gmtime(std::time(nullptr)));
  write_new(undo, former);
  fmt::print("The values of before are in {}: the same command with it brings them back.\n", undo);
  write_changes(link, changes);
}

}  // namespace

void add_ports_send_calibration(CLI::App& ports) {
  const auto [command, options] = add_command<SendCalibrationOptions>(
      ports, "send-calibration", "writes a compass calibration to an autopilot", send_calibration);
  command->add_option("LINK", options->link)->required();
  add_valued(command, "--parameters", "FILE", options->parameters)->required();
  add_number(command, "--baud", 300, 4'000'000, options->baud);
  command->add_flag("--yes", options->yes);
}

}  // namespace navcal::cli

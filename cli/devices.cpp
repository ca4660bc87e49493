// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/device_check.h"
#include "analysis/device_guess.h"
#include "base/failure.h"
#include "base/printable.h"
#include "base/progress.h"
#include "cli/decode_input.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "config/described/description_file.h"
#include "record/log/mcap_format.h"

namespace navcal::cli {
namespace {

bool is_recording(const std::string& file) {
  std::array<char, 16> begin{};
  std::ifstream in(file, std::ios::binary);
  in.read(begin.data(), begin.size());
  const std::string_view text(begin.data(), static_cast<std::size_t>(in.gcount()));
  return text.starts_with("#capture ") || text.starts_with(record::kMcapMagic);
}

/// The name of the only port of a recording.
std::string only_port(const std::string& file) {
  std::string names;
  const auto recording = record::Recording::open(file);
  const auto& ports = recording->settings().ports;
  if (ports.size() == 1) return ports.front().name;
  for (const auto& port : ports) names += (names.empty() ? "" : ", ") + port.name;
  throw base::Failure(base::Exit::usage, file + ": --port NAME says which of its ports: " + names);
}

/// Bytes of one device: a file of them (`-` is standard input), or one port of a capture or log.
class DeviceCapture {
 public:
  /// `port` may be empty when the file is no recording, or one with a single port. Throws Failure.
  DeviceCapture(const std::string& file, const std::string& port) {
    if (!port.empty() || (file != "-" && is_recording(file))) {
      port_ = std::make_unique<PortBytes>(file, port.empty() ? only_port(file) : port);
    } else {
      input_ = std::make_unique<Input>(file);
    }
  }

  /// The next bytes, with their arrival where the file has it; empty at the end.
  analysis::TimedBytes next() {
    if (!port_) return {input_->next(), std::nullopt};
    const protocols::Bytes bytes = port_->next();
    return {bytes, port_->arrival_ns()};
  }
  void show(base::Progress& progress) const {
    if (port_) {
      port_->show(progress);
    } else {
      input_->show(progress);
    }
  }

 private:
  std::unique_ptr<PortBytes> port_;
  std::unique_ptr<Input> input_;
};

struct CheckArguments {
  std::string description, capture, port;
  bool json = false;
};

struct NewArguments {
  std::string capture, port, output;
};

void check(const CheckArguments& arguments) {
  const auto description = config::load_description(arguments.description);
  DeviceCapture capture(arguments.capture, arguments.port);
  base::Progress progress("devices");
  const auto findings = analysis::check_device(description, [&] {
    const auto piece = capture.next();
    capture.show(progress);
    return piece;
  });
  std::fputs(
      base::printable(arguments.json ? analysis::to_json(findings) : analysis::to_text(findings), "\n").c_str(),
      stdout);
}

void begin(const NewArguments& arguments) {
  DeviceCapture capture(arguments.capture, arguments.port);
  constexpr std::size_t kMostBytes = std::size_t{64} << 20;
  std::vector<std::uint8_t> bytes;
  std::optional<std::int64_t> first_ns, last_ns;
  for (auto piece = capture.next(); !piece.bytes.empty() && bytes.size() < kMostBytes; piece = capture.next()) {
    bytes.insert(bytes.end(), piece.bytes.begin(), piece.bytes.end());
    if (!first_ns) first_ns = piece.arrival_ns;
    last_ns = piece.arrival_ns;
  }
  std::optional<double> seconds;
  if (first_ns && last_ns && *last_ns > *first_ns) seconds = static_cast<double>(*last_ns - *first_ns) * 1e-9;
  const std::string toml = analysis::guess_description(bytes, seconds);
  if (arguments.output.empty() || arguments.output == "-") {
    std::fputs(toml.c_str(), stdout);
  } else {
    write_new(arguments.output, toml);
  }
}

void add_capture(CLI::App& command, std::string& capture, std::string& port) {
  command.add_option("CAPTURE", capture)->required();
  command.add_option("--port", port)->type_name("NAME");
}

void add_check(CLI::App& devices) {
  const auto [command, arguments] = add_command<CheckArguments>(
      devices, "check", "What a description finds in a capture of the device's bytes", check);
  command->add_option("FILE", arguments->description)->required();
  add_capture(*command, arguments->capture, arguments->port);
  command->add_flag("--json", arguments->json);
}

void add_new(CLI::App& devices) {
  const auto [command, arguments] = add_command<NewArguments>(
      devices, "new", "Begin the description of a device from a capture of its bytes", begin);
  add_capture(*command, arguments->capture, arguments->port);
  command->add_option("-o,--output", arguments->output)->type_name("FILE.toml");
}

}  // namespace

void add_devices(CLI::App& app) {
  auto* const devices = app.add_subcommand("devices", "Devices of your own, described by a file");
  devices->require_subcommand(1);
  add_check(*devices);
  add_new(*devices);
}

}  // namespace navcal::cli

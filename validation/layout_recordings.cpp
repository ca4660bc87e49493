// SPDX-License-Identifier: Apache-2.0
#include "validation/layout_recordings.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "base/failure.h"
#include "record/whole_file.h"
#include "validation/recordings.h"

namespace navcal::validation {
namespace {

namespace thrusters = reference::thrusters;

constexpr int kMostAttempts = 20;
constexpr std::uint64_t kMissionStream = 7ULL << 40U;

/// Seeds of missions by what they belong to: vehicle and day of nominal ones, case and letter of others.
std::uint64_t mission_seed(std::uint64_t seed, std::uint64_t series, int number, int part) {
  reference::Rng dice(seed, kMissionStream + (series << 32U) + (static_cast<std::uint64_t>(number) << 8U) +
                                static_cast<std::uint64_t>(part));
  return dice.bits();
}

class FolderWriter {
 public:
  FolderWriter(const LayoutRecordingsOptions& options, const std::function<void(double)>& progress)
      : options_(options), progress_(progress), truth_(options.truth) {}

  void write() {
    write_file(options_.folder / "actuator-outputs.toml", output_description());
    write_file(options_.folder / "navcald.toml", recording_configuration());
    for (int number = 1; number <= options_.vehicles; ++number) write_vehicle(number);
    std::string known;
    for (int number = 1; number <= options_.cases; ++number) known += write_case(number);
    write_file(options_.folder / "cases.jsonl", known);
    truth_.commit();
  }

 private:
  void write_vehicle(int number) {
    vehicles_.push_back(drawn_vehicle(options_.seed, number, options_.layouts, options_.errors));
    const LayoutVehicleCase& vehicle = vehicles_.back();
    truth_.write(truth_text(vehicle, options_.seed, options_.errors) + '\n');
    write_file(options_.folder / fmt::format("vehicle-{}.toml", number), vehicle.layout.text);
    for (int day = 1; day <= options_.nominal; ++day) {
      const std::uint64_t seed = mission_seed(options_.seed, 0, number, day);
      const std::string text = capture_of(drawn_swim(vehicle, seed, 60 * options_.minutes, day),
                                          nominal_day(options_.seed, vehicle, day), seed);
      if (text.empty())
        throw base::Failure(
            base::Exit::failed,
            fmt::format("{}: the vehicle cannot swim: lost on a nominal mission", vehicle.layout.name));
      write_file(options_.folder / fmt::format("vehicle-{}-nominal-{}.cap", number, day), text);
      advance();
    }
  }

  /// The line of cases.jsonl.
  std::string write_case(int number) {
    const LayoutVehicleCase& vehicle = vehicles_[static_cast<std::size_t>(number - 1) % vehicles_.size()];
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      const LayoutCase drawn = drawn_layout_case(options_.seed, number, vehicle, attempt);
      const auto captures = captures_of(drawn, vehicle);
      if (!captures) continue;
      for (std::size_t i = 0; i < captures->size(); ++i)
        write_file(options_.folder / fmt::format("{:04}-{}.cap", number, "abc"[i]), (*captures)[i]);
      truth_.write(truth_text(drawn, options_.seed) + '\n');
      return fmt::format("{{\"case\":\"{:04}\",\"vehicle\":{},\"exclude\":\"{}\"}}\n", number, vehicle.number,
                         drawn.excluded);
    }
    throw base::Failure(base::Exit::failed,
                        fmt::format("case {}: {} draws of its effects, and the vehicle was lost with each", number,
                                    kMostAttempts));
  }

  std::optional<std::array<std::string, kRecordingsPerCase>> captures_of(const LayoutCase& drawn,
                                                                         const LayoutVehicleCase& vehicle) {
    std::array<std::string, kRecordingsPerCase> captures;
    for (std::size_t i = 0; i < captures.size(); ++i) {
      const std::uint64_t seed = mission_seed(options_.seed, 1, drawn.number, static_cast<int>(i));
      const int day = options_.nominal + drawn.number;
      captures[i] = capture_of(drawn_swim(vehicle, seed, 60 * options_.minutes, day), drawn.craft, seed);
      if (captures[i].empty()) return std::nullopt;
    }
    for (std::size_t i = 0; i < captures.size(); ++i) advance();
    return captures;
  }

  void advance() {
    const int all = options_.vehicles * options_.nominal + kRecordingsPerCase * options_.cases;
    progress_(static_cast<double>(++done_) / all);
  }

  const LayoutRecordingsOptions& options_;
  const std::function<void(double)>& progress_;
  record::WholeFile truth_;
  std::vector<LayoutVehicleCase> vehicles_;
  int done_ = 0;
};

}  // namespace

std::string capture_of(const thrusters::Swim& swim, const thrusters::CraftUnderTest& craft, std::uint64_t seed) {
  CaptureText capture(reference::kThrusterPorts);
  if (thrusters::run(swim, craft, seed, capture)) return {};
  return std::move(capture.text);
}

std::string output_description() {
  std::string text =
      "# Commands to the thrusters, ten times a second: $PNCAO,1500,1620,1500,1500,,,,*52\n"
      "# outputs 1 to 8 as pulses in us, in the order of the layout. Outputs that the vehicle does not have are "
      "empty.\n"
      "name = \"actuator outputs\"\nform = \"text\"\nbaud = 115200\nrate_Hz = 10\nlatency_ms = 5\n"
      "latency_std_ms = 0.5\n\n[[frame]]\nid = \"PNCAO\"\nstart = \"$PNCAO,\"\nchecksum = \"nmea\"\nfields = 8\n"
      "field = [\n";
  for (int i = 1; i <= 8; ++i)
    text +=
        fmt::format("  {{ sensor = \"output{}\", number = {}, unit = \"us\", low = 500, high = 2500 }},\n", i, i);
  return text + "]\n";
}

std::string recording_configuration() {
  std::string text =
      "# The ports of the recordings in this folder: navcal replay --config navcald.toml FILE.cap\n";
  for (const reference::Port port : reference::kThrusterPorts) {
    const reference::PortFacts& facts = reference::facts_of(port);
    text += fmt::format("\n[port.{}]\nprotocol = \"{}\"\nbaud = {}\npath = \"/dev/{}\"\n", facts.name,
                        facts.protocol, facts.baud, facts.name);
    if (port == reference::Port::actuators) text += "device = \"actuator-outputs.toml\"\n";
  }
  return text;
}

void write_layout_recordings(const LayoutRecordingsOptions& options, const std::function<void(double)>& progress) {
  if (options.layouts.empty()) throw std::invalid_argument("no layout is given");
  namespace fs = std::filesystem;
  fs::create_directories(options.folder);
  if (!fs::is_empty(options.folder))
    throw std::invalid_argument(options.folder.string() + ": the folder is not empty");
  const fs::path outside = fs::weakly_canonical(options.truth).lexically_relative(fs::canonical(options.folder));
  if (!outside.empty() && *outside.begin() != "..")
    throw std::invalid_argument(options.truth.string() +
                                ": the truth must not lie in the folder of the recordings");
  FolderWriter(options, progress).write();
}

}  // namespace navcal::validation

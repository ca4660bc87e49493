// SPDX-License-Identifier: Apache-2.0
#include "validation/recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <future>
#include <iterator>

#include "base/failure.h"
#include "base/interruptible.h"
#include "config/described/outputs_port.h"
#include "config/load.h"
#include "record/whole_file.h"
#include "validation/missions.h"

namespace navcal::validation {
namespace {

std::vector<config::PortSettings> settings_of(std::span<const reference::Port> ports) {
  std::vector<config::PortSettings> settings;
  for (const reference::Port port : ports) {
    const reference::PortFacts& facts = reference::facts_of(port);
    settings.push_back(config::default_port(std::string(facts.name),
                                            protocols::protocol_named(facts.protocol).value(), facts.baud));
  }
  return settings;
}

}  // namespace

CaptureText::CaptureText(std::span<const reference::Port> ports) : ports_(ports), writer_(settings_of(ports)) {
  writer_.begin(text);
}

void CaptureText::transfer(const reference::Transfer& transfer) {
  const auto place = std::ranges::find(ports_, transfer.port) - ports_.begin();
  const auto direction = transfer.sent ? record::Direction::sent : record::Direction::received;
  writer_.bytes(text, static_cast<std::uint16_t>(place), direction, transfer.time_ns, transfer.bytes);
}

void CaptureText::truth(const reference::Snapshot& /*snapshot*/) {
  if (base::Interruptible::interrupted()) throw base::Failure(base::Exit::failed, "interrupted");
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  record::WholeFile file(path);
  file.write(text);
  file.commit();
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::filesystem::path write_vehicle_file(const TrialPlace& place, const std::filesystem::path& folder) {
  write_file(folder / "vehicle.toml", fmt::format("[water]\ndensity_kg_m3 = {}\n", place.waters.density_kg_m3));
  return folder / "vehicle.toml";
}

void write_recording(const reference::Mission& mission, const reference::VehicleUnderTest& vehicle,
                     std::uint64_t seed, const std::filesystem::path& file) {
  CaptureText capture(reference::kFinnedPorts);
  if (const auto lost = reference::run(mission, vehicle, seed, capture)) {
    throw base::Failure(base::Exit::failed,
                        fmt::format("no recording: the vehicle was lost {:.1f} s into the mission", lost->time_s));
  }
  write_file(file, capture.text);
}

std::string capture_of(const LayoutRecording& recording) {
  CaptureText capture(reference::kThrusterPorts);
  if (reference::thrusters::run(recording.swim, recording.craft, recording.seed, capture)) return {};
  return std::move(capture.text);
}

std::vector<std::string> write_vehicle(const LayoutVehicle& vehicle, const std::filesystem::path& folder) {
  std::string ports = "# The ports of the recordings: navcal replay --config navcald.toml FILE.cap\n";
  for (const reference::Port port : reference::kThrusterPorts) {
    const reference::PortFacts& facts = reference::facts_of(port);
    ports += fmt::format("\n[port.{}]\nprotocol = \"{}\"\nbaud = {}\npath = \"/dev/{}\"\n", facts.name,
                         facts.protocol, facts.baud, facts.name);
    if (port == reference::Port::actuators) ports += "device = \"actuator-outputs.toml\"\n";
  }
  write_file(folder / "navcald.toml", ports);
  write_file(folder / "actuator-outputs.toml", config::outputs_description());
  write_file(folder / "sheet.toml", data_sheet(vehicle));
  std::vector<std::string> files;
  for (const LayoutRecording& recording : vehicle.nominals) {
    files.push_back(folder / fmt::format("nominal-{}.cap", files.size() + 1));
    write_file(files.back(), capture_of(recording));
  }
  return files;
}

std::array<std::filesystem::path, 3> write_recordings(const TrialCase& drawn,
                                                      const std::filesystem::path& folder) {
  const auto missions = trial_missions(facts_of(drawn.arm).missions, static_cast<int>(drawn.minutes));
  std::array<std::filesystem::path, 3> files{folder / "a.cap", folder / "b.cap", folder / "c.cap"};
  std::array<std::future<void>, 3> written;
  for (std::size_t i = 0; i < files.size(); ++i) {
    written[i] = std::async(std::launch::async, [&, i] {
      if (drawn.on_layout != nullptr) return write_file(files[i], capture_of(drawn.on_layout->recordings[i]));
      write_recording(at_place(missions[i], drawn.place), drawn.vehicle, drawn.mission_seeds[i], files[i]);
    });
  }
  for (auto& one : written) one.get();
  return files;
}

}  // namespace navcal::validation

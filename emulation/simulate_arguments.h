// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/layout.h"
#include "devices/instrument_model.h"
#include "emulation/place_arguments.h"
#include "sim/instruments/clock_factor.h"

namespace navcal::emulation {

/// A mission on the time scale of the simulated recordings begins here, without --date: 2026-01-01, 00:00:00 UTC.
inline constexpr std::int64_t kSimulatedBegin_ns = 1'767'225'600'000'000'000;

struct SimulateArguments {
  // One of these three says how the vehicle moves.
  std::filesystem::path path, drive;
  std::string mission;
  std::filesystem::path vehicle;
  std::filesystem::path config;      ///< of the instruments; empty: the reference instruments
  std::vector<std::string> effects;  ///< NAME=STRENGTH
  std::filesystem::path effects_file;
  std::vector<sim::ClockFactor> clocks;
  std::uint64_t seed = 1;
  bool no_noise = false;
  std::optional<double> seconds;
  std::filesystem::path capture, truth, report;
  PlaceArguments where;
  // Begin that `where` determines; simulate() sets it.
  std::int64_t begin_ns = kSimulatedBegin_ns;
  SimulatedPlace place;
  devices::InstrumentModel instruments;  ///< what `config` says
  /// The layout that `vehicle` is; simulate() sets it. nullopt: a vehicle of one propeller and three fins.
  std::optional<config::Layout> layout;
};

}  // namespace navcal::emulation

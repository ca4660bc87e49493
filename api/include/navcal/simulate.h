// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/export.h>
#include <navcal/progress.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace navcal::api {

/// A departure from the nominal model.
struct EffectStrength {
  std::string name;     ///< "motor_field"; `navcal simulate --list-effects` has them all
  double strength = 1;  ///< multiple of the typical strength; the direction comes from the seed
};

/// Place of a simulated vehicle, WGS84.
struct Place {
  double latitude_deg = 0;   ///< positive north, -89 to 89
  double longitude_deg = 0;  ///< positive east
  double height_m = 0;       ///< above the ellipsoid
};

/// Rate of an instrument's clock.
struct ClockRate {
  std::string port;  ///< "compass", "imu" or "motor"
  double rate = 1;   ///< over the nominal one, 0.25 to 4
};

/// Options of a simulation. The members have the names of the options of `navcal simulate`.
struct SimulateOptions {
  // One of these three says how the vehicle moves.
  std::string mission;          ///< a shipped mission by its name, or a file
  std::filesystem::path drive;  ///< file with shaft speed and fins over time
  std::filesystem::path path;   ///< file with the motion itself

  std::filesystem::path vehicle;  ///< empty: the reference vehicle
  std::filesystem::path config;   ///< configuration that describes the instruments; empty: reference instruments
  std::vector<EffectStrength> effects;  ///< departures by strength
  std::filesystem::path effects_file;   ///< departures with exact parameters; empty: none
  std::vector<ClockRate> clocks;        ///< instruments whose clocks are off
  std::optional<double> seconds;        ///< duration, 0.01 to 1e6; nullopt: to the end of path or mission
  std::optional<Place> place;           ///< the Earth's field there is the World Magnetic Model's
  std::optional<std::array<double, 3>> field_uT;  ///< north, east, down; replaces the model's field
  std::string date;             ///< YYYY-MM-DD, on which the mission begins at 00:00 UTC; empty: 2026-01-01
  std::uint64_t seed = 1;       ///< of noise, biases and directions
  bool noise = true;            ///< false: instruments without noise; resolution and latency stay
  std::filesystem::path truth;  ///< file for the true motion, 100 rows a second; empty: none
  Progress progress;            ///< its step is "simulating"
};

/// Facts of a simulation.
struct Simulation {
  double duration_s = 0;             ///< of the mission
  std::vector<std::string> remarks;  ///< for people: that the model of the field was extrapolated
};

/// Simulates a mission and writes the recording to `capture`, byte for byte as `navcal simulate` does. Files
/// appear whole or not at all. Throws Error: bad_argument where the motion is not given exactly once, or an output
/// is an input as well. Source: docs/simulator.md.
NAVCAL_API Simulation simulate(const std::filesystem::path& capture, const SimulateOptions& options);

}  // namespace navcal::api

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "base/failure.h"
#include "config/layout.h"
#include "config/vehicle.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::emulation {

/// A vehicle of one propeller and three fins, or one of any shape.
using ChosenVehicle = std::variant<config::VehicleSettings, config::Layout>;

/// The vehicle of a file, or the reference vehicle without one. A file with one of the tables body, added_mass,
/// thruster, surface, ballast and moving_mass is a layout. Throws config::Error.
[[nodiscard]] ChosenVehicle load_chosen_vehicle(const std::filesystem::path& file);

/// The layout of a file; nullopt where the file is none, or there is no file. Throws config::Error.
[[nodiscard]] std::optional<config::Layout> layout_in(const std::filesystem::path& file);
/// Nominal vehicle of a diagnosis, where it is a layout. With nominal recordings, or by mean forces, any other
/// vehicle is diagnosed as the layout that it is, too (sim::layout_of). Throws config::Error.
[[nodiscard]] std::optional<config::Layout> layout_to_diagnose(const std::filesystem::path& file,
                                                               bool has_nominals_or_is_steady);

struct MotionOnMission {
  std::unique_ptr<sim::SimulatedMotion> motion;
  std::string remark;  ///< what is less than the mission asks for; empty: nothing
};

/// A vehicle that takes a mission (a name or a file). `file` stands for the vehicle in messages. Throws
/// config::Error, and Failure where a layout cannot be simulated, or cannot do what the mission needs.
[[nodiscard]] MotionOnMission motion_on_mission(const ChosenVehicle& vehicle, const std::filesystem::path& file,
                                                const std::string& mission, const sim::MotionOptions& options);

/// Throws Failure where a layout, or what effects make of it at any time, has no equations of motion, and where it
/// has more actuators than a recording has outputs. `effects` may be null.
void expect_simulable(const config::Layout& layout, const std::filesystem::path& file,
                      sim::VehicleInfluencer* effects);

}  // namespace navcal::emulation

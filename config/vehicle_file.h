// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/error.h"
#include "config/option.h"
#include "config/vehicle.h"

namespace navcal::config {

/// Every setting of a vehicle, table by table.
[[nodiscard]] const std::vector<Option<VehicleSettings>>& vehicle_options();

/// Reads a vehicle (docs/simulator.md); what the file does not say is as in the reference vehicle. Throws Error.
[[nodiscard]] VehicleSettings load_vehicle(const std::filesystem::path& file);

/// The same from memory; `name` stands for the file in messages. Throws Error.
[[nodiscard]] VehicleSettings parse_vehicle(std::string_view toml, std::string_view name);

/// A complete file of these settings, with range and meaning of each: parse_vehicle() gives them back to the last
/// bit.
[[nodiscard]] std::string vehicle_file(const VehicleSettings& settings);

}  // namespace navcal::config

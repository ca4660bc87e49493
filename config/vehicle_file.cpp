// SPDX-License-Identifier: Apache-2.0
#include "config/vehicle_file.h"

#include <fmt/format.h>

#include <utility>

#include "config/complaints.h"
#include "config/option_lookup.h"

namespace navcal::config {
namespace {

using V = VehicleSettings;

std::vector<Option<V>> make_vehicle_options() {
  const auto water = table_of<V>("water", &V::water);
  const auto hull = table_of<V>("hull", &V::hull);
  const auto fins = table_of<V>("fins", &V::fins);
  const auto propeller = table_of<V>("propeller", &V::propeller);
  const auto damping = table_of<V>("damping", &V::damping);
  const auto autopilot = table_of<V>("autopilot", &V::autopilot);
  return {
      water.number("density_kg_m3", &WaterSettings::density_kg_m3, kKilogramsPerCubicMetre, 900, 1100),

      hull.number("length_m", &HullSettings::length_m, kMetres, 0.2, 20),
      hull.number("diameter_m", &HullSettings::diameter_m, kMetres, 0.02, 3),
      hull.number("mass_kg", &HullSettings::mass_kg, kKilograms, 0.1, 10000),
      hull.number("gravity_below_m", &HullSettings::gravity_below_m, kMetres, 0, 1),
      hull.number("roll_inertia_factor", &HullSettings::roll_inertia_factor, kNoUnit, 0.05, 2),
      hull.number("pitch_inertia_factor", &HullSettings::pitch_inertia_factor, kNoUnit, 0.1, 3),
      hull.number("roll_added_factor", &HullSettings::roll_added_factor, kNoUnit, 0, 3),
      hull.number("axial_drag", &HullSettings::axial_drag, kNoUnit, 0, 5),
      hull.number("cross_flow_drag", &HullSettings::cross_flow_drag, kNoUnit, 0, 5),
      hull.number("lift_slope_per_rad", &HullSettings::lift_slope_per_rad, kPerRadian, 0, 10),
      hull.number("lift_area_factor", &HullSettings::lift_area_factor, kNoUnit, 0, 2),
      hull.number("lift_at_m", &HullSettings::lift_at_m, kMetres, -10, 10),

      fins.number("area_m2", &FinSettings::area_m2, kSquareMetres, 0, 10),
      fins.number("lift_slope_per_rad", &FinSettings::lift_slope_per_rad, kPerRadian, 0, 10),
      fins.number("induced_drag", &FinSettings::induced_drag, kNoUnit, 0, 20),
      fins.number("stall_rad", &FinSettings::stall_rad, kRadians, 0.02, 1.57),
      fins.number("station_m", &FinSettings::station_m, kMetres, -10, 10),
      fins.number("radius_m", &FinSettings::radius_m, kMetres, 0, 2),
      fins.number("lag_s", &FinSettings::lag_s, kSeconds, 0.001, 10),
      fins.number("limit_deg", &FinSettings::limit_rad, kDegrees, 0, 80),

      propeller.number("diameter_m", &PropellerSettings::diameter_m, kMetres, 0.01, 2),
      propeller.number("thrust_at_rest", &PropellerSettings::thrust_at_rest, kNoUnit, 0, 2),
      propeller.number("thrust_slope", &PropellerSettings::thrust_slope, kNoUnit, -5, 0),
      propeller.number("torque", &PropellerSettings::torque, kNoUnit, 0, 1),
      propeller.number("torque_felt", &PropellerSettings::torque_felt, kNoUnit, 0, 1),
      propeller.number("lag_s", &PropellerSettings::lag_s, kSeconds, 0.001, 60),
      propeller.number("idle_current_A", &PropellerSettings::idle_current_A, kAmperes, 0, 100),
      propeller.number("current_A_s3", &PropellerSettings::current_A_s3, kAmperesSecondsCubed, 0, 1),

      damping.number("roll_ratio", &DampingSettings::roll_ratio, kNoUnit, 0, 10),
      damping.number("pitch_ratio", &DampingSettings::pitch_ratio, kNoUnit, 0, 10),
      damping.number("yaw_per_s", &DampingSettings::yaw_per_s, kPerSecond, 0, 100),

      autopilot.number("period_s", &AutopilotSettings::period_s, kSeconds, 0.01, 10),
      autopilot.number("rudder_per_heading", &AutopilotSettings::rudder_per_heading, kNoUnit, 0, 20),
      autopilot.number("rudder_per_turn_s", &AutopilotSettings::rudder_per_turn_s, kSeconds, 0, 20),
      autopilot.number("rudder_limit_deg", &AutopilotSettings::rudder_limit_rad, kDegrees, 1, 60),
      autopilot.number("pitch_per_depth_deg_m", &AutopilotSettings::pitch_per_depth_rad_m, kDegreesPerMetre, 0,
                       500),
      autopilot.number("pitch_per_depth_integral_deg_m_s", &AutopilotSettings::pitch_per_depth_integral_rad_m_s,
                       kDegreesPerMetreSecond, 0, 100),
      autopilot.number("pitch_limit_deg", &AutopilotSettings::pitch_limit_rad, kDegrees, 1, 60),
      autopilot.number("elevator_per_pitch", &AutopilotSettings::elevator_per_pitch, kNoUnit, 0, 20),
      autopilot.number("elevator_per_pitch_integral_per_s", &AutopilotSettings::elevator_per_pitch_integral_per_s,
                       kPerSecond, 0, 20),
      autopilot.number("elevator_per_turn_s", &AutopilotSettings::elevator_per_turn_s, kSeconds, 0, 20),
      autopilot.number("elevator_limit_deg", &AutopilotSettings::elevator_limit_rad, kDegrees, 1, 60),
      autopilot.number("shaft_per_speed_per_m", &AutopilotSettings::shaft_per_speed_per_m, kPerMetre, 0, 100),
      autopilot.number("shaft_per_way_per_m_s", &AutopilotSettings::shaft_per_way_per_m_s, kPerMetreSecond, 0,
                       100),
      autopilot.number("shaft_limit_rpm", &AutopilotSettings::shaft_limit_rps, kRpm, 1, 60000),
  };
}

}  // namespace

const std::vector<Option<V>>& vehicle_options() {
  static const std::vector<Option<V>> all = make_vehicle_options();
  return all;
}

VehicleSettings parse_vehicle(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  VehicleSettings settings;
  unsigned size_line = 1;
  for (const Entry& entry : read_document(toml, problems)) {
    if (auto refused = take_entry(vehicle_options(), settings, entry)) {
      problems.push_back({entry.line, entry.name(), std::move(*refused)});
    }
    if (entry.name() == "hull.length_m" || entry.name() == "hull.diameter_m") size_line = entry.line;
  }
  if (!(settings.hull.diameter_m < settings.hull.length_m)) {
    problems.push_back(
        {size_line, "hull.diameter_m",
         fmt::format("{} m is not less than the length, {} m", settings.hull.diameter_m, settings.hull.length_m)});
  }
  refuse(std::move(problems), name);
  return settings;
}

VehicleSettings load_vehicle(const std::filesystem::path& file) {
  return parse_vehicle(content_of(file), file.native());
}

std::string vehicle_file(const VehicleSettings& settings) {
  const std::string out =
      "# A vehicle of the simulator: navcal simulate --vehicle FILE, navcal emulate --vehicle FILE. What is not\n"
      "# given is as here: a miniature AUV with one propeller and three fins. The equations are in "
      "docs/simulator.md.\n";
  const auto heading = [](std::string_view table) {
    return fmt::format("\n# {}\n[{}]\n", option_text(table), table);
  };
  return out + text_of(vehicle_options(), heading, [&](const auto& option) {
           return fmt::format("\n# {} ({})\n{} = {}\n", option.description, option.allowed(), option.key,
                              option.write(option.get(settings)));
         });
}

}  // namespace navcal::config

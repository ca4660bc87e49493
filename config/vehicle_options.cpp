// SPDX-License-Identifier: Apache-2.0
#include "config/vehicle_options.h"

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
      water.number("density_kg_m3", &WaterSettings::density_kg_m3, kKilogramsPerCubicMetre, 900, 1100,
                   "Its density."),

      hull.number("length_m", &HullSettings::length_m, kMetres, 0.2, 20, "Length."),
      hull.number("diameter_m", &HullSettings::diameter_m, kMetres, 0.02, 3, "Diameter; less than the length."),
      hull.number("mass_kg", &HullSettings::mass_kg, kKilograms, 0.1, 10000, "Mass."),
      hull.number("gravity_below_m", &HullSettings::gravity_below_m, kMetres, 0, 1,
                  "The centre of gravity below the origin."),
      hull.number("roll_inertia_factor", &HullSettings::roll_inertia_factor, kNoUnit, 0.05, 2,
                  "Ix over m b^2, b half the diameter, about the centre of gravity."),
      hull.number("pitch_inertia_factor", &HullSettings::pitch_inertia_factor, kNoUnit, 0.1, 3,
                  "Iy and Iz over m (L^2/12 + b^2/4), likewise."),
      hull.number("roll_added_factor", &HullSettings::roll_added_factor, kNoUnit, 0, 3,
                  "Added inertia in roll over Ix; the other added masses are Lamb's for a spheroid of this size."),
      hull.number("axial_drag", &HullSettings::axial_drag, kNoUnit, 0, 5,
                  "Coefficient of axial drag, on the area of the midship section."),
      hull.number("cross_flow_drag", &HullSettings::cross_flow_drag, kNoUnit, 0, 5,
                  "Coefficient of cross-flow drag, on the width of each of 21 stations."),
      hull.number("lift_slope_per_rad", &HullSettings::lift_slope_per_rad, kPerRadian, 0, 10,
                  "Slope of the body's lift, on lift_area_factor L D."),
      hull.number("lift_area_factor", &HullSettings::lift_area_factor, kNoUnit, 0, 2, "See lift_slope_per_rad."),
      hull.number("lift_at_m", &HullSettings::lift_at_m, kMetres, -10, 10,
                  "Where the body's lift acts, forward of the origin."),

      fins.number("area_m2", &FinSettings::area_m2, kSquareMetres, 0, 10, "Area of each fin."),
      fins.number("lift_slope_per_rad", &FinSettings::lift_slope_per_rad, kPerRadian, 0, 10,
                  "Slope of the lift of each fin."),
      fins.number("induced_drag", &FinSettings::induced_drag, kNoUnit, 0, 20,
                  "Drag over pressure, area and the square of the angle of attack (rad)."),
      fins.number("stall_rad", &FinSettings::stall_rad, kRadians, 0.02, 1.57,
                  "Angle of attack beyond which the lift no longer increases."),
      fins.number("station_m", &FinSettings::station_m, kMetres, -10, 10,
                  "Position of the fins, forward of the origin: negative at the tail."),
      fins.number("radius_m", &FinSettings::radius_m, kMetres, 0, 2,
                  "Distance of their centres of pressure from the axis."),
      fins.number("lag_s", &FinSettings::lag_s, kSeconds, 0.001, 10, "First-order lag of the servos."),
      fins.number("limit_deg", &FinSettings::limit_rad, kDegrees, 0, 80,
                  "Maximum angle of the servos, to both sides."),

      propeller.number("diameter_m", &PropellerSettings::diameter_m, kMetres, 0.01, 2, "Diameter."),
      propeller.number("thrust_at_rest", &PropellerSettings::thrust_at_rest, kNoUnit, 0, 2, "KT at J = 0."),
      propeller.number("thrust_slope", &PropellerSettings::thrust_slope, kNoUnit, -5, 0, "Slope of KT over J."),
      propeller.number("torque", &PropellerSettings::torque, kNoUnit, 0, 1, "Torque coefficient KQ."),
      propeller.number("torque_felt", &PropellerSettings::torque_felt, kNoUnit, 0, 1,
                       "Share of the torque that acts on the hull."),
      propeller.number("lag_s", &PropellerSettings::lag_s, kSeconds, 0.001, 60,
                       "First-order lag of the shaft speed."),
      propeller.number("idle_current_A", &PropellerSettings::idle_current_A, kAmperes, 0, 100,
                       "Current of the motor at standstill."),
      propeller.number("current_A_s3", &PropellerSettings::current_A_s3, kAmperesSecondsCubed, 0, 1,
                       "Additional current of the motor, over the cube of the shaft speed in rev/s."),

      damping.number("roll_ratio", &DampingSettings::roll_ratio, kNoUnit, 0, 10,
                     "Damping of roll, as a ratio of the critical one."),
      damping.number("pitch_ratio", &DampingSettings::pitch_ratio, kNoUnit, 0, 10,
                     "Damping of pitch, as a ratio of the critical one."),
      damping.number("yaw_per_s", &DampingSettings::yaw_per_s, kPerSecond, 0, 100,
                     "Damping of yaw: moment over inertia and rate."),

      autopilot.number("period_s", &AutopilotSettings::period_s, kSeconds, 0.01, 10,
                       "Rate of the autopilot's commands."),
      autopilot.number("rudder_per_heading", &AutopilotSettings::rudder_per_heading, kNoUnit, 0, 20,
                       "Rudder over heading error."),
      autopilot.number("rudder_per_turn_s", &AutopilotSettings::rudder_per_turn_s, kSeconds, 0, 20,
                       "Rudder over rate of turn in excess of the commanded one."),
      autopilot.number("rudder_limit_deg", &AutopilotSettings::rudder_limit_rad, kDegrees, 1, 60,
                       "Greatest rudder."),
      autopilot.number("pitch_per_depth_deg_m", &AutopilotSettings::pitch_per_depth_rad_m, kDegreesPerMetre, 0,
                       500, "Pitch over depth error."),
      autopilot.number("pitch_per_depth_integral_deg_m_s", &AutopilotSettings::pitch_per_depth_integral_rad_m_s,
                       kDegreesPerMetreSecond, 0, 100, "Pitch over the integral of depth error."),
      autopilot.number("pitch_limit_deg", &AutopilotSettings::pitch_limit_rad, kDegrees, 1, 60, "Steepest pitch."),
      autopilot.number("elevator_per_pitch", &AutopilotSettings::elevator_per_pitch, kNoUnit, 0, 20,
                       "Elevator over pitch error."),
      autopilot.number("elevator_per_pitch_integral_per_s", &AutopilotSettings::elevator_per_pitch_integral_per_s,
                       kPerSecond, 0, 20, "Elevator over the integral of pitch error."),
      autopilot.number("elevator_per_turn_s", &AutopilotSettings::elevator_per_turn_s, kSeconds, 0, 20,
                       "Elevator over rate of pitch."),
      autopilot.number("elevator_limit_deg", &AutopilotSettings::elevator_limit_rad, kDegrees, 1, 60,
                       "Greatest elevator."),
      autopilot.number(
          "shaft_per_speed_per_m", &AutopilotSettings::shaft_per_speed_per_m, kPerMetre, 0, 100,
          "Shaft speed (rev/s) over speed error (m/s), added to the shaft speed that balances the drag."),
      autopilot.number("shaft_per_way_per_m_s", &AutopilotSettings::shaft_per_way_per_m_s, kPerMetreSecond, 0, 100,
                       "Shaft speed (rev/s) over the integral of speed error (m)."),
      autopilot.number("shaft_limit_rpm", &AutopilotSettings::shaft_limit_rps, kRpm, 1, 60000,
                       "Maximum shaft speed."),
  };
}

}  // namespace

const std::vector<Option<V>>& vehicle_options() {
  static const std::vector<Option<V>> all = make_vehicle_options();
  return all;
}

std::string_view vehicle_table_description(std::string_view table) {
  if (table == "water") return "The water.";
  if (table == "hull")
    return "The hull. The vehicle is neutrally buoyant: its weight is its buoyancy, and the origin the centre of "
           "buoyancy.";
  if (table == "fins")
    return "The three fins, 120 degrees apart: the first up, then starboard-down and port-down.";
  if (table == "propeller")
    return "Propeller and motor: thrust coefficient KT = max(thrust_at_rest + thrust_slope J, 0), J = u/(n D).";
  if (table == "damping") return "Linear damping.";
  if (table == "autopilot")
    return "The autopilot: heading to rudder, depth to pitch to elevator, speed to shaft speed.";
  return {};
}

}  // namespace navcal::config

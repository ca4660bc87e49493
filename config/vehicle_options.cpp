// SPDX-License-Identifier: Apache-2.0
#include "config/vehicle_options.h"

#include <initializer_list>

namespace navcal::config {
namespace {

using V = VehicleSettings;

template <class Part>
struct Row {
  std::string_view key;
  double Part::*value;
  Unit unit;
  double low, high;  ///< in that unit
  std::string_view description;
};

template <class Part>
void add(std::vector<Option<V>>& options, std::string_view table, Part V::*part,
         std::initializer_list<Row<Part>> rows) {
  for (const Row<Part>& row : rows) {
    options.push_back(NumberOf<V>{table}(
        row.key, row.description, row.unit, row.low, row.high,
        [ part, value = row.value ](auto& v) -> auto& { return (v.*part).*value; }));
  }
}

void add_water(std::vector<Option<V>>& options) {
  using S = WaterSettings;
  add<S>(options, "water", &V::water,
         {
             {"density_kg_m3", &S::density_kg_m3, kKilogramsPerCubicMetre, 900, 1100, "Its density."},
         });
}

void add_hull(std::vector<Option<V>>& options) {
  using S = HullSettings;
  add<S>(options, "hull", &V::hull,
         {
             {"length_m", &S::length_m, kMetres, 0.2, 20, "Length."},
             {"diameter_m", &S::diameter_m, kMetres, 0.02, 3, "Diameter; less than the length."},
             {"mass_kg", &S::mass_kg, kKilograms, 0.1, 10000, "Mass."},
             {"gravity_below_m", &S::gravity_below_m, kMetres, 0, 1, "The centre of gravity below the origin."},
             {"roll_inertia_factor", &S::roll_inertia_factor, kNoUnit, 0.05, 2,
              "Ix over m b^2, b half the diameter, about the centre of gravity."},
             {"pitch_inertia_factor", &S::pitch_inertia_factor, kNoUnit, 0.1, 3,
              "Iy and Iz over m (L^2/12 + b^2/4), likewise."},
             {"roll_added_factor", &S::roll_added_factor, kNoUnit, 0, 3,
              "Added inertia in roll over Ix; the other added masses are Lamb's for a spheroid of this size."},
             {"axial_drag", &S::axial_drag, kNoUnit, 0, 5,
              "Coefficient of axial drag, on the area of the midship section."},
             {"cross_flow_drag", &S::cross_flow_drag, kNoUnit, 0, 5,
              "Coefficient of cross-flow drag, on the width of each of 21 stations."},
             {"lift_slope_per_rad", &S::lift_slope_per_rad, kPerRadian, 0, 10,
              "Slope of the body's lift, on lift_area_factor L D."},
             {"lift_area_factor", &S::lift_area_factor, kNoUnit, 0, 2, "See lift_slope_per_rad."},
             {"lift_at_m", &S::lift_at_m, kMetres, -10, 10, "Where the body's lift acts, forward of the origin."},
         });
}

void add_fins(std::vector<Option<V>>& options) {
  using S = FinSettings;
  add<S>(options, "fins", &V::fins,
         {
             {"area_m2", &S::area_m2, kSquareMetres, 0, 10, "Area of each fin."},
             {"lift_slope_per_rad", &S::lift_slope_per_rad, kPerRadian, 0, 10, "Slope of the lift of each fin."},
             {"induced_drag", &S::induced_drag, kNoUnit, 0, 20,
              "Drag over pressure, area and the square of the angle of attack (rad)."},
             {"stall_rad", &S::stall_rad, kRadians, 0.02, 1.57,
              "Angle of attack beyond which the lift no longer increases."},
             {"station_m", &S::station_m, kMetres, -10, 10,
              "Position of the fins, forward of the origin: negative at the tail."},
             {"radius_m", &S::radius_m, kMetres, 0, 2, "Distance of their centres of pressure from the axis."},
             {"lag_s", &S::lag_s, kSeconds, 0.001, 10, "First-order lag of the servos."},
             {"limit_deg", &S::limit_rad, kDegrees, 0, 80, "Maximum angle of the servos, to both sides."},
         });
}

void add_propeller(std::vector<Option<V>>& options) {
  using S = PropellerSettings;
  add<S>(options, "propeller", &V::propeller,
         {
             {"diameter_m", &S::diameter_m, kMetres, 0.01, 2, "Diameter."},
             {"thrust_at_rest", &S::thrust_at_rest, kNoUnit, 0, 2, "KT at J = 0."},
             {"thrust_slope", &S::thrust_slope, kNoUnit, -5, 0, "Slope of KT over J."},
             {"torque", &S::torque, kNoUnit, 0, 1, "Torque coefficient KQ."},
             {"torque_felt", &S::torque_felt, kNoUnit, 0, 1, "Share of the torque that acts on the hull."},
             {"lag_s", &S::lag_s, kSeconds, 0.001, 60, "First-order lag of the shaft speed."},
             {"idle_current_A", &S::idle_current_A, kAmperes, 0, 100, "Current of the motor at standstill."},
             {"current_A_s3", &S::current_A_s3, kAmperesSecondsCubed, 0, 1,
              "Additional current of the motor, over the cube of the shaft speed in rev/s."},
         });
}

void add_damping(std::vector<Option<V>>& options) {
  using S = DampingSettings;
  add<S>(options, "damping", &V::damping,
         {
             {"roll_ratio", &S::roll_ratio, kNoUnit, 0, 10, "Damping of roll, as a ratio of the critical one."},
             {"pitch_ratio", &S::pitch_ratio, kNoUnit, 0, 10, "Damping of pitch, as a ratio of the critical one."},
             {"yaw_per_s", &S::yaw_per_s, kPerSecond, 0, 100, "Damping of yaw: moment over inertia and rate."},
         });
}

void add_autopilot(std::vector<Option<V>>& options) {
  using S = AutopilotSettings;
  add<S>(options, "autopilot", &V::autopilot,
         {
             {"period_s", &S::period_s, kSeconds, 0.01, 10, "Rate of the autopilot's commands."},
             {"rudder_per_heading", &S::rudder_per_heading, kNoUnit, 0, 20, "Rudder over heading error."},
             {"rudder_per_turn_s", &S::rudder_per_turn_s, kSeconds, 0, 20,
              "Rudder over rate of turn in excess of the commanded one."},
             {"rudder_limit_deg", &S::rudder_limit_rad, kDegrees, 1, 60, "Greatest rudder."},
             {"pitch_per_depth_deg_m", &S::pitch_per_depth_rad_m, kDegreesPerMetre, 0, 500,
              "Pitch over depth error."},
             {"pitch_per_depth_integral_deg_m_s", &S::pitch_per_depth_integral_rad_m_s, kDegreesPerMetreSecond, 0,
              100, "Pitch over the integral of depth error."},
             {"pitch_limit_deg", &S::pitch_limit_rad, kDegrees, 1, 60, "Steepest pitch."},
             {"elevator_per_pitch", &S::elevator_per_pitch, kNoUnit, 0, 20, "Elevator over pitch error."},
             {"elevator_per_pitch_integral_per_s", &S::elevator_per_pitch_integral_per_s, kPerSecond, 0, 20,
              "Elevator over the integral of pitch error."},
             {"elevator_per_turn_s", &S::elevator_per_turn_s, kSeconds, 0, 20, "Elevator over rate of pitch."},
             {"elevator_limit_deg", &S::elevator_limit_rad, kDegrees, 1, 60, "Greatest elevator."},
             {"shaft_per_speed_per_m", &S::shaft_per_speed_per_m, kPerMetre, 0, 100,
              "Shaft speed (rev/s) over speed error (m/s), added to the shaft speed that balances the drag."},
             {"shaft_per_way_per_m_s", &S::shaft_per_way_per_m_s, kPerMetreSecond, 0, 100,
              "Shaft speed (rev/s) over the integral of speed error (m)."},
             {"shaft_limit_rpm", &S::shaft_limit_rps, kRpm, 1, 60000, "Maximum shaft speed."},
         });
}

}  // namespace

const std::vector<Option<V>>& vehicle_options() {
  static const std::vector<Option<V>> all = [] {
    std::vector<Option<V>> options;
    add_water(options);
    add_hull(options);
    add_fins(options);
    add_propeller(options);
    add_damping(options);
    add_autopilot(options);
    return options;
  }();
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "config/layout.h"

/// The members of the tables of a layout, once, in the order of a file. The reader (layout_table.h), the writer
/// (layout_text.cpp) and the list of numbers (layout_numbers.cpp) are the tables that these functions go through;
/// `if constexpr (Table::kReads)` marks what concerns the reader alone.
namespace navcal::config::layout {

struct Bounds {
  double low, high;
  std::string_view unit = {};         ///< in messages
  std::string_view true_unit = unit;  ///< of the number, also where messages leave it out
  bool is_setting = false;            ///< known exactly: no parameter that an identification could fit
};
constexpr Bounds as_setting(Bounds bounds) {
  bounds.is_setting = true;
  return bounds;
}

inline constexpr Bounds kPlace{-50, 50, "m"}, kLag{0.001, 60, "s"};
inline constexpr Bounds kQuadratic{-1e6, 1e6, {}, "kg/m, kg, kg m, kg m2"};
inline constexpr Bounds kPerSpeed{-1e6, 1e6, {}, "kg/m"}, kPerTurn{-1e6, 1e6, {}, "kg"};

struct CommandUnitRow {
  std::string_view name;
  CommandUnit unit;
  Bounds bounds;
  double low, high;  ///< default limits
};
/// In the order of CommandUnit.
inline constexpr std::array<CommandUnitRow, 3> kCommandUnits{
    {{"rpm", CommandUnit::rpm, {-60000, 60000, "rpm"}, 0, 0},
     {"percent", CommandUnit::percent, {-100, 100, "%"}, -100, 100},
     {"us", CommandUnit::microseconds, {800, 2200, "us"}, 1100, 1900}}};
constexpr const CommandUnitRow& row_of(CommandUnit unit) {
  return kCommandUnits.at(static_cast<std::size_t>(unit));
}

class LayoutTable;
void check_spheroid(LayoutTable& table, const LayoutSpheroid& spheroid);
void check_propeller(LayoutTable& table, LayoutThruster& thruster);
void check_force_table(LayoutTable& table, LayoutThruster& thruster);
void check_moving_mass(LayoutTable& table, const LayoutMovingMass& mass);

template <class Table>
void go_through(Table& table, auto& added) requires requires {
  added.matrix_kg;
}
{
  table.matrix("matrix", added.matrix_kg, {-1e6, 1e6, "kg, kg m, kg m2"}, true);
  table.part("spheroid", added.spheroid, [](auto& part, auto& spheroid) {
    part.number("length_m", spheroid.length_m, {0.05, 50, "m"});
    part.number("diameter_m", spheroid.diameter_m, {0.01, 20, "m"});
    part.require("length_m", "length of the spheroid (m)");
    part.require("diameter_m", "diameter of the spheroid (m)");
    if constexpr (Table::kReads) check_spheroid(part, spheroid);
  });
  table.part("strips", !added.strips.x_m.empty(), [&](auto& part) { part.strips(added.strips); });
}

template <class Table>
void go_through(Table& table, auto& damping) requires requires {
  damping.quadratic;
}
{
  table.matrix("linear", damping.linear, {-1e6, 1e6, {}, "N s/m, N s, N m s"});
  table.matrix("quadratic", damping.quadratic, kQuadratic);
  table.matrix("lift", damping.lift, kQuadratic);
  table.numbers_unless(LayoutDamping{}.factors, "factors", damping.factors, as_setting({0, 100}));
  table.part("axial", damping.axial_area_m2 > 0, [&](auto& part) {
    part.number("coefficient", damping.axial_coefficient, {0, 10});
    part.number("area_m2", damping.axial_area_m2, {0, 1000, "m2"});
    part.require("coefficient", "coefficient of axial drag (0 to 10)");
    part.require("area_m2", "area that it counts on (0 to 1000 m2)");
  });
  table.part("body_lift", damping.body_lift_area_m2 > 0, [&](auto& part) {
    part.number("slope_per_rad", damping.body_lift_slope_per_rad, {0, 20, "1/rad"});
    part.number("area_m2", damping.body_lift_area_m2, {0, 1000, "m2"});
    part.number("at_m", damping.body_lift_at_m, kPlace);
    part.require("slope_per_rad", "slope of the body's lift (0 to 20 1/rad)");
    part.require("area_m2", "area that it counts on (0 to 1000 m2)");
  });
  table.part("cross_flow", !damping.strips.x_m.empty(), [&](auto& part) {
    part.number("coefficient", damping.cross_flow_coefficient, {0, 10});
    part.require("coefficient", "coefficient of cross-flow drag (0 to 10)");
    part.strips(damping.strips);
  });
  table.part("flow_axes", damping.flow_axes, [](auto& part, auto& flow) {
    part.numbers("lift_kg_m", flow.lift_kg_m, kPerSpeed);
    part.numbers("drag_kg_m", flow.drag_kg_m, {0, 1e6, "kg/m"});
    part.number("side_kg_m", flow.side_kg_m, kPerSpeed);
    part.number("roll_kg", flow.roll_kg, kPerTurn);
    part.numbers("pitch_kg", flow.pitch_kg, kPerTurn);
    part.number("yaw_kg", flow.yaw_kg, kPerTurn);
    part.angle("stall_deg", flow.stall_rad, {1, 90, "deg"});
  });
}

/// What an actuator makes of its command: scale and offset, the latter in the command's unit.
void go_through_heard(auto& table, auto& heard, const Bounds& offset) {
  table.number_unless(1, "command_scale", heard.scale, as_setting({-10, 10}));
  table.number_unless(0, "command_offset", heard.offset, as_setting(offset));
}

template <class Table>
void go_through(Table& table, auto& thruster) requires requires {
  thruster.KT;
}
{
  table.identity(thruster, "");
  table.numbers("place_m", thruster.place_m, kPlace);
  table.direction("direction", thruster.direction);
  table.require("place_m", "[x, y, z] of the propeller's centre (m)");
  table.require("direction", "[x, y, z] of its forward thrust");
  table.command(thruster);
  const Bounds command = row_of(thruster.unit).bounds;
  const auto propeller = [&] {
    table.number("diameter_m", thruster.diameter_m, {0.005, 5, "m"});
    table.list("KT", thruster.KT, {-10, 10});
    table.list("KQ", thruster.KQ, {-10, 10});
    if constexpr (Table::kReads) check_propeller(table, thruster);
  };
  const auto force_table = [&] {
    table.list("table_command", thruster.table_command, command);
    table.list("table_force_N", thruster.table_force_N, {-1e6, 1e6, "N"});
    table.number("advance_loss_sqrtN_s_m", thruster.advance_loss_sqrtN_s_m, {0, 1000, "sqrt(N) s/m"});
    table.number("torque_m", thruster.torque_m, {0, 10, "m"});
    if constexpr (Table::kReads) check_force_table(table, thruster);
  };
  table.either("diameter_m", thruster.diameter_m > 0, propeller, force_table);
  table.number("force_scale", thruster.force_scale, {0, 100});
  table.number("reverse_efficiency", thruster.reverse_efficiency, {0, 1});
  table.number("torque_share", thruster.torque_share, {0, 1});
  table.hand(thruster.is_left_handed);
  table.number("dead_band", thruster.dead_band, {0, command.high, command.unit, {}});
  table.number("lag_s", thruster.lag_s, kLag);
  if constexpr (Table::kReads) table.limits("limits", thruster.low, thruster.high, command);
  go_through_heard(table, thruster.heard, {-command.high, command.high, command.unit});
  if (thruster.unit == CommandUnit::rpm) table.require("limits", "[LOW, HIGH] of the command (rpm)");
}

void go_through(auto& table, auto& surface) requires requires { surface.chord; }
{
  table.identity(surface, "");
  table.numbers("place_m", surface.place_m, kPlace);
  table.direction("normal", surface.normal);
  table.direction("chord", surface.chord);
  table.require("place_m", "[x, y, z] of the centre of pressure (m)");
  table.require("normal", "[x, y, z] of the force at a positive angle");
  table.number("area_m2", surface.area_m2, {0, 100, "m2"});
  table.number("lift_slope_per_rad", surface.lift_slope_per_rad, {0, 20, "1/rad"});
  table.require("area_m2", "area that the coefficients count on (0 to 100 m2)");
  table.require("lift_slope_per_rad", "slope of its lift (0 to 20 1/rad)");
  table.number("induced_drag", surface.induced_drag, {0, 20});
  table.number("drag", surface.drag, {0, 5});
  table.angle("stall_deg", surface.stall_rad, {1, 90, "deg"});
  table.number("lag_s", surface.lag_s, kLag);
  table.angle("limit_deg", surface.limit_rad, as_setting({0, 80, "deg"}));
  table.angle_unless(0, "dead_band_deg", surface.dead_band_rad, as_setting({0, 80, "deg"}));
  table.number_unless(1, "command_scale", surface.heard.scale, as_setting({-10, 10}));
  table.angle_unless(0, "command_offset_deg", surface.heard.offset, as_setting({-80, 80, "deg"}));
}

void go_through(auto& table, auto& ballast) requires requires { ballast.rate_N_s; }
{
  table.identity(ballast, "ballast");
  table.numbers("place_m", ballast.place_m, kPlace);
  table.limits("range_N", ballast.low_N, ballast.high_N, {-1e6, 1e6, "N"});
  table.number("rate_N_s", ballast.rate_N_s, {1e-6, 1e5, "N/s"});
  go_through_heard(table, ballast.heard, {-1e6, 1e6, "N"});
  table.require("range_N", "[LOW, HIGH] of the added buoyancy (N)");
  table.require("rate_N_s", "greatest change of the added buoyancy (N/s)");
}

template <class Table>
void go_through(Table& table, auto& mass) requires requires {
  mass.rate_m_s;
}
{
  table.identity(mass, "moving_mass");
  table.number("mass_kg", mass.mass_kg, {0.001, 1e6, "kg"});
  table.numbers("place_m", mass.place_m, kPlace);
  table.direction("axis", mass.axis, true);
  table.limits("range_m", mass.low_m, mass.high_m, {-20, 20, "m"});
  table.number("rate_m_s", mass.rate_m_s, {1e-6, 10, "m/s"});
  go_through_heard(table, mass.heard, {-20, 20, "m"});
  table.require("mass_kg", "the part of the body's mass that moves (kg)");
  table.require("range_m", "[LOW, HIGH] of its way from place_m (m)");
  if constexpr (Table::kReads) check_moving_mass(table, mass);
}

/// `visit(key, list)` for each kind of actuator.
void for_each_kind(auto& layout, auto visit) {
  visit("thruster", layout.thrusters);
  visit("surface", layout.surfaces);
  visit("ballast", layout.ballasts);
  visit("moving_mass", layout.moving_masses);
}

}  // namespace navcal::config::layout

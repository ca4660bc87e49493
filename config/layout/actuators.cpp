// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "config/layout/layout_table.h"

namespace navcal::config::layout {
namespace {

constexpr Bounds kActuatorPlace{-50, 50, "m"};
constexpr Bounds kLag{0.001, 60, "s"};

struct UnitOfCommand {
  std::string_view name;
  CommandUnit unit;
  Bounds bounds;
  double low, high;  ///< default limits
};

constexpr std::array<UnitOfCommand, 3> kUnits{{{"rpm", CommandUnit::rpm, {-60000, 60000, "rpm"}, 0, 0},
                                               {"percent", CommandUnit::percent, {-100, 100, "%"}, -100, 100},
                                               {"us", CommandUnit::microseconds, {800, 2200, "us"}, 1100, 1900}}};

const UnitOfCommand& unit_of(LayoutTable& table) {
  const auto given = table.reader().choice("command", {"rpm", "percent", "us"});
  table.reader().require("command", "unit of the command: rpm, percent or us");
  const auto found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitOfCommand& unit) { return unit.name == given; });
  return found != kUnits.end() ? *found : kUnits.front();
}

void read_propeller(LayoutTable& table, LayoutThruster& thruster) {
  table.number("diameter_m", thruster.diameter_m, {0.005, 5, "m"});
  table.list("KT", thruster.KT, {-10, 10});
  table.list("KQ", thruster.KQ, {-10, 10});
  table.reader().require("KT", "thrust coefficient over advance ratio, from the constant term on");
  if (thruster.unit != CommandUnit::rpm)
    table.reader().complain("command", "a propeller with KT takes rpm; others take a table of force over command");
  if (thruster.diameter_m > 0 && thruster.KT.empty()) thruster.KT = {0};
}

void read_table(LayoutTable& table, LayoutThruster& thruster, const Bounds& bounds) {
  table.list("table_command", thruster.table_command, bounds);
  table.list("table_force_N", thruster.table_force_N, {-1e6, 1e6, "N"});
  table.number("advance_loss_sqrtN_s_m", thruster.advance_loss_sqrtN_s_m, {0, 1000, "sqrt(N) s/m"});
  table.number("torque_m", thruster.torque_m, {0, 10, "m"});
  table.reader().require("table_command", "commands of a table of force, or diameter_m and KT of a propeller");
  table.reader().require("table_force_N", "force at each command of table_command (N)");
  auto& commands = thruster.table_command;
  bool is_good = commands.size() >= 2 && commands.size() == thruster.table_force_N.size();
  if (table.reader().has("table_force_N") && !is_good && !commands.empty())
    table.reader().complain("table_force_N",
                            fmt::format("{} forces for {} commands; two or more of each are expected",
                                        thruster.table_force_N.size(), commands.size()));
  if (std::adjacent_find(commands.begin(), commands.end(), std::greater_equal<>()) != commands.end()) {
    table.reader().complain("table_command", "the commands do not increase");
    is_good = false;
  }
  if (is_good) return;
  commands = {-1, 1};
  thruster.table_force_N = {0, 0};
}

/// What an actuator makes of its command: scale and offset, the latter in the command's unit.
void read_heard(LayoutTable& table, LayoutHeard& heard, const Bounds& offset) {
  table.number("command_scale", heard.scale, {-10, 10});
  table.number("command_offset", heard.offset, offset);
}

bool is_taken(const std::string& name, const Layout& layout) {
  const auto has_name = [&](const auto& actuator) { return actuator.name == name; };
  return std::any_of(layout.thrusters.begin(), layout.thrusters.end(), has_name) ||
         std::any_of(layout.surfaces.begin(), layout.surfaces.end(), has_name) ||
         std::any_of(layout.ballasts.begin(), layout.ballasts.end(), has_name) ||
         std::any_of(layout.moving_masses.begin(), layout.moving_masses.end(), has_name);
}

/// Reads the name of an actuator over the one that it has; complains about one that another actuator has.
void read_name(LayoutTable& table, std::string& name, const Layout& layout) {
  if (auto given = table.reader().text("name")) name = std::move(*given);
  if (!name.empty() && is_taken(name, layout))
    table.reader().complain("name", fmt::format("\"{}\" is already the name of another actuator", name));
}

void read_channel(LayoutTable& table, std::string& channel) {
  if (auto given = table.reader().text("channel")) channel = std::move(*given);
}

void require_name(LayoutTable& table) { table.reader().require("name", "a name of its own, such as \"port\""); }

}  // namespace

void read_thruster(const Node& node, Layout& layout, std::vector<Problem>& problems) {
  LayoutTable table(node, layout, problems);
  LayoutThruster thruster;
  read_name(table, thruster.name, layout);
  read_channel(table, thruster.channel);
  require_name(table);
  table.numbers("place_m", thruster.place_m, kActuatorPlace);
  table.direction("direction", thruster.direction);
  table.reader().require("place_m", "[x, y, z] of the propeller's centre (m)");
  table.reader().require("direction", "[x, y, z] of its forward thrust");
  const UnitOfCommand& unit = unit_of(table);
  thruster.unit = unit.unit;
  thruster.low = unit.low;
  thruster.high = unit.high;
  if (table.reader().has("diameter_m")) {
    read_propeller(table, thruster);
  } else {
    read_table(table, thruster, unit.bounds);
  }
  table.number("force_scale", thruster.force_scale, {0, 100});
  table.number("reverse_efficiency", thruster.reverse_efficiency, {0, 1});
  table.number("torque_share", thruster.torque_share, {0, 1});
  thruster.is_left_handed = table.reader().choice("hand", {"right", "left"}) == "left";
  table.number("dead_band", thruster.dead_band, {0, unit.bounds.high, unit.bounds.unit});
  table.number("lag_s", thruster.lag_s, kLag);
  table.limits("limits", thruster.low, thruster.high, unit.bounds);
  read_heard(table, thruster.heard, {-unit.bounds.high, unit.bounds.high, unit.bounds.unit});
  if (thruster.unit == CommandUnit::rpm) table.reader().require("limits", "[LOW, HIGH] of the command (rpm)");
  table.finish();
  layout.thrusters.push_back(std::move(thruster));
}

void read_surface(const Node& node, Layout& layout, std::vector<Problem>& problems) {
  LayoutTable table(node, layout, problems);
  LayoutSurface surface;
  read_name(table, surface.name, layout);
  read_channel(table, surface.channel);
  require_name(table);
  table.numbers("place_m", surface.place_m, kActuatorPlace);
  table.direction("normal", surface.normal);
  table.direction("chord", surface.chord);
  table.reader().require("place_m", "[x, y, z] of the centre of pressure (m)");
  table.reader().require("normal", "[x, y, z] of the force at a positive angle");
  table.number("area_m2", surface.area_m2, {0, 100, "m2"});
  table.number("lift_slope_per_rad", surface.lift_slope_per_rad, {0, 20, "1/rad"});
  table.reader().require("area_m2", "area that the coefficients count on (0 to 100 m2)");
  table.reader().require("lift_slope_per_rad", "slope of its lift (0 to 20 1/rad)");
  table.number("induced_drag", surface.induced_drag, {0, 20});
  table.number("drag", surface.drag, {0, 5});
  table.angle("stall_deg", surface.stall_rad, {1, 90, "deg"});
  table.number("lag_s", surface.lag_s, kLag);
  table.angle("limit_deg", surface.limit_rad, {0, 80, "deg"});
  table.angle("dead_band_deg", surface.dead_band_rad, {0, 80, "deg"});
  table.number("command_scale", surface.heard.scale, {-10, 10});
  table.angle("command_offset_deg", surface.heard.offset, {-80, 80, "deg"});
  table.finish();
  layout.surfaces.push_back(std::move(surface));
}

void read_ballast(const Node& node, Layout& layout, std::vector<Problem>& problems) {
  LayoutTable table(node, layout, problems);
  LayoutBallast ballast;
  ballast.name = "ballast";
  read_name(table, ballast.name, layout);
  read_channel(table, ballast.channel);
  table.numbers("place_m", ballast.place_m, kActuatorPlace);
  table.limits("range_N", ballast.low_N, ballast.high_N, {-1e6, 1e6, "N"});
  table.number("rate_N_s", ballast.rate_N_s, {1e-6, 1e5, "N/s"});
  read_heard(table, ballast.heard, {-1e6, 1e6, "N"});
  table.reader().require("range_N", "[LOW, HIGH] of the added buoyancy (N)");
  table.reader().require("rate_N_s", "greatest change of the added buoyancy (N/s)");
  table.finish();
  layout.ballasts.push_back(std::move(ballast));
}

void read_moving_mass(const Node& node, Layout& layout, std::vector<Problem>& problems) {
  LayoutTable table(node, layout, problems);
  LayoutMovingMass mass;
  mass.name = "moving_mass";
  read_name(table, mass.name, layout);
  read_channel(table, mass.channel);
  table.number("mass_kg", mass.mass_kg, {0.001, 1e6, "kg"});
  table.numbers("place_m", mass.place_m, kActuatorPlace);
  table.direction("axis", mass.axis);
  table.limits("range_m", mass.low_m, mass.high_m, {-20, 20, "m"});
  table.number("rate_m_s", mass.rate_m_s, {1e-6, 10, "m/s"});
  read_heard(table, mass.heard, {-20, 20, "m"});
  table.reader().require("mass_kg", "the part of the body's mass that moves (kg)");
  table.reader().require("range_m", "[LOW, HIGH] of its way from place_m (m)");
  if (mass.mass_kg >= layout.body.mass_kg && layout.body.mass_kg > 0)
    table.reader().complain("mass_kg",
                            fmt::format("{} kg is not less than the mass of the body, {} kg, which it is part of",
                                        mass.mass_kg, layout.body.mass_kg));
  table.finish();
  layout.moving_masses.push_back(std::move(mass));
}

}  // namespace navcal::config::layout

// SPDX-License-Identifier: Apache-2.0
#include "config/layout/layout_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "config/complaints.h"
#include "config/document.h"
#include "config/layout/layout_table.h"

namespace navcal::config {
namespace layout {
namespace {

void read_inertia(LayoutTable& table, LayoutBody& body) {
  constexpr Bounds kMoment{-1e10, 1e10, "kg m2"};
  const Node* node = table.reader().find("inertia_kg_m2");
  const auto* given = node != nullptr ? std::get_if<std::vector<double>>(&node->value) : nullptr;
  table.numbers("inertia_kg_m2", body.inertia_kg_m2.data(), given != nullptr && given->size() == 6 ? 6 : 3,
                kMoment);
  table.require("inertia_kg_m2", "[Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] (kg m2)");
  const auto about = table.reader().choice("inertia_about", {"gravity", "origin"});
  if (about != "origin") return;
  // Parallel axes: I_G = I_O - m (r'r 1 - r r').
  const auto& [x, y, z] = body.gravity_centre_m;
  const double m = body.mass_kg;
  auto& I = body.inertia_kg_m2;
  I = {I[0] - m * (y * y + z * z), I[1] - m * (x * x + z * z), I[2] - m * (x * x + y * y),
       I[3] + m * x * y,           I[4] + m * x * z,           I[5] + m * y * z};
}

void read_body(LayoutTable& table, LayoutBody& body, double density_kg_m3) {
  table.number("mass_kg", body.mass_kg, {0.01, 1e6, "kg"});
  table.require("mass_kg", "mass of the whole vehicle (0.01 to 1000000 kg)");
  table.numbers("gravity_centre_m", body.gravity_centre_m, kPlace);
  table.numbers("buoyancy_centre_m", body.buoyancy_centre_m, kPlace);
  read_inertia(table, body);
  table.numbers("size_m", body.size_m, {0, 50, "m"});
  double volume_m3 = 0;
  table.number("buoyancy_N", body.buoyancy_N, {0, 2e7, "N"});
  table.number("volume_m3", volume_m3, {0, 1000, "m3"});
  bool is_neutral = false;
  if (const Node* node = table.reader().find("neutral")) {
    const bool* neutral = std::get_if<bool>(&node->value);
    if (neutral == nullptr) table.reader().complain("neutral", "true or false is expected");
    is_neutral = neutral != nullptr && *neutral;
  }
  const int stated = static_cast<int>(table.reader().has("buoyancy_N")) +
                     static_cast<int>(table.reader().has("volume_m3")) + static_cast<int>(is_neutral);
  if (stated != 1)
    table.reader().complain(stated == 0 ? "buoyancy_N" : "volume_m3",
                            "exactly one of buoyancy_N (N), volume_m3 (m3) and neutral = true is expected");
  if (stated == 1) {
    body.is_neutral = is_neutral;
    body.volume_m3 = volume_m3;
  }
  body.set_buoyancy(density_kg_m3);
}

}  // namespace

void check_spheroid(LayoutTable& table, const LayoutSpheroid& spheroid) {
  if (spheroid.length_m > 0 && spheroid.diameter_m > 0 && spheroid.diameter_m >= spheroid.length_m)
    table.reader().complain("diameter_m", fmt::format("{} m is not less than the length, {} m",
                                                      spheroid.diameter_m, spheroid.length_m));
}

void check_propeller(LayoutTable& table, LayoutThruster& thruster) {
  table.require("KT", "thrust coefficient over advance ratio, from the constant term on");
  if (thruster.unit != CommandUnit::rpm)
    table.reader().complain("command", "a propeller with KT takes rpm; others take a table of force over command");
  if (thruster.diameter_m > 0 && thruster.KT.empty()) thruster.KT = {0};
}

void check_force_table(LayoutTable& table, LayoutThruster& thruster) {
  table.require("table_command", "commands of a table of force, or diameter_m and KT of a propeller");
  table.require("table_force_N", "force at each command of table_command (N)");
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

void check_moving_mass(LayoutTable& table, const LayoutMovingMass& mass) {
  const LayoutBody& body = table.layout().body;
  if (mass.mass_kg >= body.mass_kg && body.mass_kg > 0)
    table.reader().complain("mass_kg",
                            fmt::format("{} kg is not less than the mass of the body, {} kg, which it is part of",
                                        mass.mass_kg, body.mass_kg));
}

}  // namespace layout

Layout read_layout(std::string_view toml, std::vector<Problem>& problems) {
  Layout layout;
  if (toml.size() > kMaxLayout) {
    problems.push_back({1, "", fmt::format("the layout has more than {} bytes", kMaxLayout)});
    return layout;
  }
  const std::size_t before = problems.size();
  const Node root = read_tree(toml, problems);
  if (problems.size() > before) return layout;
  layout::LayoutTable table(root, layout, problems);
  if (auto name = table.reader().text("name")) layout.name = std::move(*name);
  table.part("water", true, [&](layout::LayoutTable& water) {
    water.number("density_kg_m3", layout.water_density_kg_m3, {900, 1100, "kg/m3"});
  });
  table.require("body", "a layout has a table [body]");
  table.part("body", true,
             [&](layout::LayoutTable& body) { layout::read_body(body, layout.body, layout.water_density_kg_m3); });
  table.part("added_mass", true, [&](auto& part) { layout::go_through(part, layout.added_mass); });
  auto& spheroid = layout.added_mass.spheroid;
  if (spheroid && !(spheroid->diameter_m < spheroid->length_m && spheroid->diameter_m > 0)) spheroid.reset();
  table.part("damping", true, [&](auto& part) { layout::go_through(part, layout.damping); });
  layout::for_each_kind(layout, [&]<class Actuator>(std::string_view key, std::vector<Actuator>& list) {
    const auto nodes = table.reader().tables(key);
    if (nodes.size() > kMaxActuators)
      return table.reader().complain(key, fmt::format("{} of them; {} is the most", nodes.size(), kMaxActuators));
    for (const Node* node : nodes) {
      Actuator actuator;
      table.read(*node, [&](auto& part) { layout::go_through(part, actuator); });
      list.push_back(std::move(actuator));
    }
  });
  table.finish();
  return layout;
}

Layout parse_layout(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  Layout layout = read_layout(toml, problems);
  refuse(std::move(problems), name);
  return layout;
}

bool is_layout(std::string_view toml) {
  constexpr std::array<std::string_view, 6> kTables{"body",    "added_mass", "thruster",
                                                    "surface", "ballast",    "moving_mass"};
  std::vector<Problem> problems;
  return std::ranges::any_of(read_document(toml, problems), [&](const Entry& entry) {
    return std::find(kTables.begin(), kTables.end(), entry.keys.front()) != kTables.end();
  });
}

Layout load_layout(const std::filesystem::path& file) { return parse_layout(content_of(file), file.native()); }

}  // namespace navcal::config

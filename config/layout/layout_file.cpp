// SPDX-License-Identifier: Apache-2.0
#include "config/layout/layout_file.h"

#include <fmt/format.h>

#include "config/complaints.h"
#include "config/layout/layout_table.h"

namespace navcal::config {
namespace {

using ReadActuator = void (*)(const Node&, Layout&, std::vector<Problem>&);

void read_actuators(layout::LayoutTable& table, std::string_view key, ReadActuator read, Layout& layout,
                    std::vector<Problem>& problems) {
  const auto nodes = table.reader().tables(key);
  if (nodes.size() > kMaxActuators) {
    table.reader().complain(key, fmt::format("{} of them; {} is the most", nodes.size(), kMaxActuators));
    return;
  }
  for (const Node* node : nodes) read(*node, layout, problems);
}

}  // namespace

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
  if (const Node* water = table.below("water")) {
    layout::LayoutTable keys(*water, layout, problems);
    keys.number("density_kg_m3", layout.water_density_kg_m3, {900, 1100, "kg/m3"});
    keys.finish();
  }
  table.reader().require("body", "a layout has a table [body]");
  if (const Node* body = table.below("body")) {
    layout::LayoutTable keys(*body, layout, problems);
    layout::read_body(keys, layout.body, layout.water_density_kg_m3);
  }
  if (const Node* added = table.below("added_mass")) layout::read_added_mass(*added, layout, problems);
  if (const Node* damping = table.below("damping")) layout::read_damping(*damping, layout, problems);
  read_actuators(table, "thruster", layout::read_thruster, layout, problems);
  read_actuators(table, "surface", layout::read_surface, layout, problems);
  read_actuators(table, "ballast", layout::read_ballast, layout, problems);
  read_actuators(table, "moving_mass", layout::read_moving_mass, layout, problems);
  table.finish();
  return layout;
}

Layout parse_layout(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  Layout layout = read_layout(toml, problems);
  refuse(std::move(problems), name);
  return layout;
}

Layout load_layout(const std::filesystem::path& file) { return parse_layout(content_of(file), file.native()); }

}  // namespace navcal::config

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "config/layout/layout_table.h"

namespace navcal::config::layout {
namespace {

constexpr Bounds kLayoutPlace{-50, 50, "m"};
constexpr Bounds kCoefficient{-1e6, 1e6};

void read_inertia(LayoutTable& table, LayoutBody& body) {
  constexpr Bounds kMoment{-1e10, 1e10, "kg m2"};
  const Node* node = table.reader().find("inertia_kg_m2");
  const auto* given = node != nullptr ? std::get_if<std::vector<double>>(&node->value) : nullptr;
  table.numbers("inertia_kg_m2", body.inertia_kg_m2.data(), given != nullptr && given->size() == 6 ? 6 : 3,
                kMoment);
  table.reader().require("inertia_kg_m2", "[Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] (kg m2)");
  const auto about = table.reader().choice("inertia_about", {"gravity", "origin"});
  if (about != "origin") return;
  // Parallel axes: I_G = I_O - m (r'r 1 - r r').
  const auto& [x, y, z] = body.gravity_centre_m;
  const double m = body.mass_kg;
  auto& I = body.inertia_kg_m2;
  I = {I[0] - m * (y * y + z * z), I[1] - m * (x * x + z * z), I[2] - m * (x * x + y * y),
       I[3] + m * x * y,           I[4] + m * x * z,           I[5] + m * y * z};
}

void read_spheroid(const Node& node, Layout& layout, std::vector<Problem>& problems) {
  LayoutTable table(node, layout, problems);
  LayoutSpheroid spheroid;
  table.number("length_m", spheroid.length_m, {0.05, 50, "m"});
  table.number("diameter_m", spheroid.diameter_m, {0.01, 20, "m"});
  table.reader().require("length_m", "length of the spheroid (m)");
  table.reader().require("diameter_m", "diameter of the spheroid (m)");
  table.finish();
  if (spheroid.diameter_m < spheroid.length_m && spheroid.diameter_m > 0) {
    layout.added_mass.spheroid = spheroid;
  } else if (spheroid.length_m > 0 && spheroid.diameter_m > 0) {
    table.reader().complain("diameter_m", fmt::format("{} m is not less than the length, {} m",
                                                      spheroid.diameter_m, spheroid.length_m));
  }
}

void read_flow_axes(const Node& node, Layout& layout, std::vector<Problem>& problems) {
  LayoutTable table(node, layout, problems);
  LayoutFlowAxes flow;
  table.numbers("lift_kg_m", flow.lift_kg_m, kCoefficient);
  table.numbers("drag_kg_m", flow.drag_kg_m, {0, 1e6, "kg/m"});
  table.number("side_kg_m", flow.side_kg_m, kCoefficient);
  table.number("roll_kg", flow.roll_kg, kCoefficient);
  table.numbers("pitch_kg", flow.pitch_kg, kCoefficient);
  table.number("yaw_kg", flow.yaw_kg, kCoefficient);
  table.angle("stall_deg", flow.stall_rad, {1, 90, "deg"});
  table.finish();
  layout.damping.flow_axes = flow;
}

void read_cross_flow(const Node& node, Layout& layout, std::vector<Problem>& problems) {
  LayoutTable table(node, layout, problems);
  table.number("coefficient", layout.damping.cross_flow_coefficient, {0, 10});
  table.reader().require("coefficient", "coefficient of cross-flow drag (0 to 10)");
  table.strips(layout.damping.strips);
  table.finish();
}

}  // namespace

void read_body(LayoutTable& table, LayoutBody& body, double density_kg_m3) {
  table.number("mass_kg", body.mass_kg, {0.01, 1e6, "kg"});
  table.reader().require("mass_kg", "mass of the whole vehicle (0.01 to 1000000 kg)");
  table.numbers("gravity_centre_m", body.gravity_centre_m, kLayoutPlace);
  table.numbers("buoyancy_centre_m", body.buoyancy_centre_m, kLayoutPlace);
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
  table.finish();
}

void read_added_mass(const Node& node, Layout& layout, std::vector<Problem>& problems) {
  LayoutTable table(node, layout, problems);
  table.matrix("matrix", layout.added_mass.matrix_kg, {-1e6, 1e6, "kg, kg m, kg m2"});
  if (const Node* below = table.below("spheroid")) read_spheroid(*below, layout, problems);
  if (const Node* below = table.below("strips")) {
    LayoutTable strips(*below, layout, problems);
    strips.strips(layout.added_mass.strips);
    strips.finish();
  }
  table.finish();
}

void read_damping(const Node& node, Layout& layout, std::vector<Problem>& problems) {
  LayoutTable table(node, layout, problems);
  LayoutDamping& damping = layout.damping;
  table.matrix("linear", damping.linear, kCoefficient);
  table.matrix("quadratic", damping.quadratic, kCoefficient);
  table.matrix("lift", damping.lift, kCoefficient);
  table.numbers("factors", damping.factors, {0, 100});
  if (const Node* below = table.below("axial")) {
    LayoutTable axial(*below, layout, problems);
    axial.number("coefficient", damping.axial_coefficient, {0, 10});
    axial.number("area_m2", damping.axial_area_m2, {0, 1000, "m2"});
    axial.reader().require("coefficient", "coefficient of axial drag (0 to 10)");
    axial.reader().require("area_m2", "area that it counts on (0 to 1000 m2)");
    axial.finish();
  }
  if (const Node* below = table.below("body_lift")) {
    LayoutTable lift(*below, layout, problems);
    lift.number("slope_per_rad", damping.body_lift_slope_per_rad, {0, 20, "1/rad"});
    lift.number("area_m2", damping.body_lift_area_m2, {0, 1000, "m2"});
    lift.number("at_m", damping.body_lift_at_m, kLayoutPlace);
    lift.reader().require("slope_per_rad", "slope of the body's lift (0 to 20 1/rad)");
    lift.reader().require("area_m2", "area that it counts on (0 to 1000 m2)");
    lift.finish();
  }
  if (const Node* below = table.below("cross_flow")) read_cross_flow(*below, layout, problems);
  if (const Node* below = table.below("flow_axes")) read_flow_axes(*below, layout, problems);
  table.finish();
}

}  // namespace navcal::config::layout

// SPDX-License-Identifier: Apache-2.0
#include "config/layout/layout_numbers.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "base/angles.h"

namespace navcal::config {
namespace {

/// The keys of one layout with their numbers, in the order of the file.
class NumberTable {
 public:
  explicit NumberTable(Layout& layout) {
    signed_number("water.density_kg_m3", layout.water_density_kg_m3, "kg/m3");
    body(layout.body);
    matrix("added_mass.matrix", layout.added_mass.matrix_kg, "kg, kg m, kg m2", true);
    if (layout.added_mass.spheroid) {
      number("added_mass.spheroid.length_m", layout.added_mass.spheroid->length_m, "m");
      number("added_mass.spheroid.diameter_m", layout.added_mass.spheroid->diameter_m, "m");
    }
    damping(layout.damping);
    for (std::size_t i = 0; i < layout.thrusters.size(); ++i) thruster(layout.thrusters[i], i + 1);
    for (std::size_t i = 0; i < layout.surfaces.size(); ++i) surface(layout.surfaces[i], i + 1);
    for (std::size_t i = 0; i < layout.ballasts.size(); ++i) {
      const std::string name = fmt::format("ballast[{}].", i + 1);
      numbers(name + "place_m", layout.ballasts[i].place_m, "m");
      number(name + "rate_N_s", layout.ballasts[i].rate_N_s, "N/s");
    }
    for (std::size_t i = 0; i < layout.moving_masses.size(); ++i) {
      const std::string name = fmt::format("moving_mass[{}].", i + 1);
      number(name + "mass_kg", layout.moving_masses[i].mass_kg, "kg");
      numbers(name + "place_m", layout.moving_masses[i].place_m, "m");
      number(name + "rate_m_s", layout.moving_masses[i].rate_m_s, "m/s");
    }
  }

  [[nodiscard]] std::optional<LayoutNumbers> find(std::string_view key) const {
    for (const auto& [name, numbers] : rows_) {
      if (name == key) return numbers;
    }
    return std::nullopt;
  }

 private:
  void number(std::string key, double& value, std::string_view unit) {
    rows_.emplace_back(std::move(key), LayoutNumbers{&value, 1, 1, unit, true, false});
  }
  void signed_number(std::string key, double& value, std::string_view unit) {
    rows_.emplace_back(std::move(key), LayoutNumbers{&value, 1, 1, unit, false, false});
  }
  void angle(std::string key, double& value_rad) {
    rows_.emplace_back(std::move(key), LayoutNumbers{&value_rad, 1, base::kRadiansPerDegree, "deg", true, false});
  }
  template <std::size_t N>
  void numbers(std::string key, std::array<double, N>& values, std::string_view unit) {
    rows_.emplace_back(std::move(key), LayoutNumbers{values.data(), N, 1, unit, false, false});
  }
  void matrix(std::string key, LayoutMatrix& values, std::string_view unit, bool is_symmetric) {
    rows_.emplace_back(std::move(key), LayoutNumbers{values.data(), values.size(), 1, unit, false, is_symmetric});
  }

  void body(LayoutBody& body) {
    number("body.mass_kg", body.mass_kg, "kg");
    numbers("body.gravity_centre_m", body.gravity_centre_m, "m");
    numbers("body.buoyancy_centre_m", body.buoyancy_centre_m, "m");
    numbers("body.inertia_kg_m2", body.inertia_kg_m2, "kg m2");
    if (body.volume_m3 > 0) {
      number("body.volume_m3", body.volume_m3, "m3");
    } else if (!body.is_neutral) {
      number("body.buoyancy_N", body.buoyancy_N, "N");
    }
  }
  void damping(LayoutDamping& damping) {
    matrix("damping.linear", damping.linear, "N s/m, N s, N m s", false);
    matrix("damping.quadratic", damping.quadratic, "kg/m, kg, kg m, kg m2", false);
    matrix("damping.lift", damping.lift, "kg/m, kg, kg m, kg m2", false);
    number("damping.axial.coefficient", damping.axial_coefficient, "");
    number("damping.axial.area_m2", damping.axial_area_m2, "m2");
    number("damping.body_lift.slope_per_rad", damping.body_lift_slope_per_rad, "1/rad");
    number("damping.body_lift.area_m2", damping.body_lift_area_m2, "m2");
    signed_number("damping.body_lift.at_m", damping.body_lift_at_m, "m");
    number("damping.cross_flow.coefficient", damping.cross_flow_coefficient, "");
    if (!damping.flow_axes) return;
    LayoutFlowAxes& flow = *damping.flow_axes;
    numbers("damping.flow_axes.lift_kg_m", flow.lift_kg_m, "kg/m");
    numbers("damping.flow_axes.drag_kg_m", flow.drag_kg_m, "kg/m");
    signed_number("damping.flow_axes.side_kg_m", flow.side_kg_m, "kg/m");
    signed_number("damping.flow_axes.roll_kg", flow.roll_kg, "kg");
    numbers("damping.flow_axes.pitch_kg", flow.pitch_kg, "kg");
    signed_number("damping.flow_axes.yaw_kg", flow.yaw_kg, "kg");
    angle("damping.flow_axes.stall_deg", flow.stall_rad);
  }
  void thruster(LayoutThruster& thruster, std::size_t number_of_it) {
    const std::string name = fmt::format("thruster[{}].", number_of_it);
    numbers(name + "place_m", thruster.place_m, "m");
    numbers(name + "direction", thruster.direction, "");
    number(name + "diameter_m", thruster.diameter_m, "m");
    number(name + "advance_loss_sqrtN_s_m", thruster.advance_loss_sqrtN_s_m, "sqrt(N) s/m");
    number(name + "torque_m", thruster.torque_m, "m");
    number(name + "force_scale", thruster.force_scale, "");
    number(name + "reverse_efficiency", thruster.reverse_efficiency, "");
    number(name + "torque_share", thruster.torque_share, "");
    number(name + "dead_band", thruster.dead_band, "");
    number(name + "lag_s", thruster.lag_s, "s");
  }
  void surface(LayoutSurface& surface, std::size_t number_of_it) {
    const std::string name = fmt::format("surface[{}].", number_of_it);
    numbers(name + "place_m", surface.place_m, "m");
    numbers(name + "normal", surface.normal, "");
    numbers(name + "chord", surface.chord, "");
    number(name + "area_m2", surface.area_m2, "m2");
    number(name + "lift_slope_per_rad", surface.lift_slope_per_rad, "1/rad");
    number(name + "induced_drag", surface.induced_drag, "");
    number(name + "drag", surface.drag, "");
    angle(name + "stall_deg", surface.stall_rad);
    number(name + "lag_s", surface.lag_s, "s");
  }

  std::vector<std::pair<std::string, LayoutNumbers>> rows_;
};

}  // namespace

std::optional<LayoutNumbers> find_numbers(Layout& layout, std::string_view key) {
  return NumberTable(layout).find(key);
}

}  // namespace navcal::config

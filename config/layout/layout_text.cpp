// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "config/layout/layout_file.h"
#include "config/value.h"

namespace navcal::config {
namespace {

/// Degrees that convert back to the same radians, where there are any.
double exact_degrees(double rad) {
  const double near = rad * base::kDegreesPerRadian;
  constexpr double kDigits = 1e6;
  for (const double degrees :
       {std::round(near * kDigits) / kDigits, near, std::nextafter(near, 1e9), std::nextafter(near, -1e9)}) {
    if (degrees * base::kRadiansPerDegree == rad) return degrees;
  }
  return near;
}

/// Writes one table after the other; errors of numbers and sources behind the table that they belong to.
class LayoutText {
 public:
  explicit LayoutText(const Layout& layout) : layout_(layout) {}

  /// `name` as the reader names the table: "thruster[2]".
  void table(std::string_view header, std::string_view name) {
    out_ += fmt::format("\n{}\n", header);
    name_ = name;
    for (const LayoutSource& source : layout_.sources) {
      if (source.table == name) line("source", to_toml_text(source.text));
    }
  }
  void line(std::string_view key, std::string_view value) { out_ += fmt::format("{} = {}\n", key, value); }
  void number(std::string_view key, double value) {
    line(key, to_toml_text(value));
    uncertainty(key);
  }
  void angle(std::string_view key, double rad) { number(key, exact_degrees(rad)); }
  template <class Values>
  void numbers(std::string_view key, const Values& values) {
    line(key, fmt::format("[{}]", fmt::join(values, ", ")));
    uncertainty(key);
  }
  /// What a sound actuator has is left out.
  void heard(const LayoutHeard& heard) {
    if (heard.scale != 1) number("command_scale", heard.scale);
    if (heard.offset != 0) number("command_offset", heard.offset);
  }
  void matrix(std::string_view key, const LayoutMatrix& values) {
    std::vector<double> diagonal;
    for (std::size_t i = 0; i < 6; ++i) diagonal.push_back(values[7 * i]);
    bool is_diagonal = true;
    for (std::size_t i = 0; i < 36; ++i) is_diagonal = is_diagonal && (i % 7 == 0 || values[i] == 0);
    if (is_diagonal) return numbers(key, diagonal);
    std::string rows;
    for (std::size_t i = 0; i < 36; i += 6)
      rows += fmt::format("\n  {},", fmt::join(values.begin() + static_cast<std::ptrdiff_t>(i),
                                               values.begin() + static_cast<std::ptrdiff_t>(i + 6), ", "));
    line(key, "[" + rows + "\n]");
    uncertainty(key);
  }
  void strips(const LayoutStrips& strips) {
    numbers("x_m", strips.x_m);
    numbers("length_m", strips.length_m);
    numbers("width_m", strips.width_m);
    if (strips.height_m != strips.width_m) numbers("height_m", strips.height_m);
  }
  std::string take() { return std::move(out_); }

 private:
  void uncertainty(std::string_view key) {
    const std::string name = fmt::format("{}.{}", name_, key);
    for (const LayoutUncertainty& about : layout_.uncertainties) {
      if (about.key != name) continue;
      if (about.std) line(fmt::format("{}_std", key), to_toml_text(*about.std));
      if (!about.stds.empty()) line(fmt::format("{}_std", key), fmt::format("[{}]", fmt::join(about.stds, ", ")));
      if (about.range)
        line(fmt::format("{}_range", key), fmt::format("[{}, {}]", about.range->first, about.range->second));
    }
  }

  const Layout& layout_;
  std::string out_, name_;
};

void write_body(LayoutText& text, const LayoutBody& body) {
  text.table("[body]", "body");
  text.number("mass_kg", body.mass_kg);
  text.numbers("gravity_centre_m", body.gravity_centre_m);
  text.numbers("buoyancy_centre_m", body.buoyancy_centre_m);
  text.numbers("inertia_kg_m2", body.inertia_kg_m2);
  if (body.is_neutral) {
    text.line("neutral", "true");
  } else if (body.volume_m3 > 0) {
    text.number("volume_m3", body.volume_m3);
  } else {
    text.number("buoyancy_N", body.buoyancy_N);
  }
  text.numbers("size_m", body.size_m);
}

void write_added_mass(LayoutText& text, const LayoutAddedMass& added) {
  text.table("[added_mass]", "added_mass");
  text.matrix("matrix", added.matrix_kg);
  if (added.spheroid) {
    text.table("[added_mass.spheroid]", "added_mass.spheroid");
    text.number("length_m", added.spheroid->length_m);
    text.number("diameter_m", added.spheroid->diameter_m);
  }
  if (added.strips.x_m.empty()) return;
  text.table("[added_mass.strips]", "added_mass.strips");
  text.strips(added.strips);
}

void write_flow_axes(LayoutText& text, const LayoutFlowAxes& flow) {
  text.table("[damping.flow_axes]", "damping.flow_axes");
  text.numbers("lift_kg_m", flow.lift_kg_m);
  text.numbers("drag_kg_m", flow.drag_kg_m);
  text.number("side_kg_m", flow.side_kg_m);
  text.number("roll_kg", flow.roll_kg);
  text.numbers("pitch_kg", flow.pitch_kg);
  text.number("yaw_kg", flow.yaw_kg);
  text.angle("stall_deg", flow.stall_rad);
}

void write_damping(LayoutText& text, const LayoutDamping& damping) {
  text.table("[damping]", "damping");
  text.matrix("linear", damping.linear);
  text.matrix("quadratic", damping.quadratic);
  text.matrix("lift", damping.lift);
  if (damping.factors != LayoutDamping{}.factors) text.numbers("factors", damping.factors);
  if (damping.axial_area_m2 > 0) {
    text.table("[damping.axial]", "damping.axial");
    text.number("coefficient", damping.axial_coefficient);
    text.number("area_m2", damping.axial_area_m2);
  }
  if (damping.body_lift_area_m2 > 0) {
    text.table("[damping.body_lift]", "damping.body_lift");
    text.number("slope_per_rad", damping.body_lift_slope_per_rad);
    text.number("area_m2", damping.body_lift_area_m2);
    text.number("at_m", damping.body_lift_at_m);
  }
  if (!damping.strips.x_m.empty()) {
    text.table("[damping.cross_flow]", "damping.cross_flow");
    text.number("coefficient", damping.cross_flow_coefficient);
    text.strips(damping.strips);
  }
  if (damping.flow_axes) write_flow_axes(text, *damping.flow_axes);
}

std::string_view word_for(CommandUnit unit) {
  switch (unit) {
    case CommandUnit::rpm: return "rpm";
    case CommandUnit::percent: return "percent";
    case CommandUnit::microseconds: return "us";
  }
  return "";
}

void write_thruster(LayoutText& text, const LayoutThruster& thruster, std::size_t number) {
  text.table("[[thruster]]", fmt::format("thruster[{}]", number));
  text.line("name", to_toml_text(thruster.name));
  if (!thruster.channel.empty()) text.line("channel", to_toml_text(thruster.channel));
  text.numbers("place_m", thruster.place_m);
  text.numbers("direction", thruster.direction);
  text.line("command", to_toml_text(std::string(word_for(thruster.unit))));
  text.numbers("limits", std::array{thruster.low, thruster.high});
  if (thruster.diameter_m > 0) {
    text.number("diameter_m", thruster.diameter_m);
    text.numbers("KT", thruster.KT);
    if (!thruster.KQ.empty()) text.numbers("KQ", thruster.KQ);
  } else {
    text.numbers("table_command", thruster.table_command);
    text.numbers("table_force_N", thruster.table_force_N);
    text.number("advance_loss_sqrtN_s_m", thruster.advance_loss_sqrtN_s_m);
    text.number("torque_m", thruster.torque_m);
  }
  text.number("force_scale", thruster.force_scale);
  text.number("reverse_efficiency", thruster.reverse_efficiency);
  text.number("torque_share", thruster.torque_share);
  text.line("hand", thruster.is_left_handed ? "\"left\"" : "\"right\"");
  text.number("dead_band", thruster.dead_band);
  text.number("lag_s", thruster.lag_s);
  text.heard(thruster.heard);
}

void write_surface(LayoutText& text, const LayoutSurface& surface, std::size_t number) {
  text.table("[[surface]]", fmt::format("surface[{}]", number));
  text.line("name", to_toml_text(surface.name));
  if (!surface.channel.empty()) text.line("channel", to_toml_text(surface.channel));
  text.numbers("place_m", surface.place_m);
  text.numbers("normal", surface.normal);
  text.numbers("chord", surface.chord);
  text.number("area_m2", surface.area_m2);
  text.number("lift_slope_per_rad", surface.lift_slope_per_rad);
  text.number("induced_drag", surface.induced_drag);
  text.number("drag", surface.drag);
  text.angle("stall_deg", surface.stall_rad);
  text.number("lag_s", surface.lag_s);
  text.angle("limit_deg", surface.limit_rad);
  if (surface.dead_band_rad != 0) text.angle("dead_band_deg", surface.dead_band_rad);
  if (surface.heard.scale != 1) text.number("command_scale", surface.heard.scale);
  if (surface.heard.offset != 0) text.angle("command_offset_deg", surface.heard.offset);
}

void write_masses(LayoutText& text, const Layout& layout) {
  for (std::size_t i = 0; i < layout.ballasts.size(); ++i) {
    const LayoutBallast& ballast = layout.ballasts[i];
    text.table("[[ballast]]", fmt::format("ballast[{}]", i + 1));
    text.line("name", to_toml_text(ballast.name));
    if (!ballast.channel.empty()) text.line("channel", to_toml_text(ballast.channel));
    text.numbers("place_m", ballast.place_m);
    text.numbers("range_N", std::array{ballast.low_N, ballast.high_N});
    text.number("rate_N_s", ballast.rate_N_s);
    text.heard(ballast.heard);
  }
  for (std::size_t i = 0; i < layout.moving_masses.size(); ++i) {
    const LayoutMovingMass& mass = layout.moving_masses[i];
    text.table("[[moving_mass]]", fmt::format("moving_mass[{}]", i + 1));
    text.line("name", to_toml_text(mass.name));
    if (!mass.channel.empty()) text.line("channel", to_toml_text(mass.channel));
    text.number("mass_kg", mass.mass_kg);
    text.numbers("place_m", mass.place_m);
    text.numbers("axis", mass.axis);
    text.numbers("range_m", std::array{mass.low_m, mass.high_m});
    text.number("rate_m_s", mass.rate_m_s);
    text.heard(mass.heard);
  }
}

}  // namespace

std::string layout_file(const Layout& layout) {
  LayoutText text(layout);
  text.table("# Layout of a vehicle (docs/vehicles.md): navcal vehicle check FILE.", "");
  text.line("name", to_toml_text(layout.name));
  text.table("[water]", "water");
  text.number("density_kg_m3", layout.water_density_kg_m3);
  write_body(text, layout.body);
  write_added_mass(text, layout.added_mass);
  write_damping(text, layout.damping);
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) write_thruster(text, layout.thrusters[i], i + 1);
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i) write_surface(text, layout.surfaces[i], i + 1);
  write_masses(text, layout);
  return text.take().substr(1);
}

}  // namespace navcal::config

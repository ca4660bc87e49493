// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "config/layout/layout_file.h"
#include "config/layout/members.h"
#include "config/value.h"

namespace navcal::config {
namespace {

using layout::Bounds;

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
  static constexpr bool kReads = false;
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
  void text(std::string_view key, const std::string& text) { line(key, to_toml_text(text)); }
  void number(std::string_view key, double value, const Bounds& = {}) {
    line(key, to_toml_text(value));
    uncertainty(key);
  }
  void angle(std::string_view key, double rad, const Bounds&) { number(key, exact_degrees(rad)); }
  template <class Values>
  void numbers(std::string_view key, const Values& values, const Bounds& = {}) {
    line(key, fmt::format("[{}]", fmt::join(values, ", ")));
    uncertainty(key);
  }
  void list(std::string_view key, const std::vector<double>& values, const Bounds&) {
    if (!values.empty()) numbers(key, values);
  }
  void direction(std::string_view key, const LayoutVector& value, bool = false) { numbers(key, value); }
  void limits(std::string_view key, double low, double high, const Bounds&) {
    numbers(key, std::array{low, high});
  }
  // Left out where they have their usual value.
  void number_unless(double usual, std::string_view key, double value, const Bounds&) {
    if (value != usual) number(key, value);
  }
  void angle_unless(double usual, std::string_view key, double rad, const Bounds& bounds) {
    if (rad != usual) angle(key, rad, bounds);
  }
  template <class Values>
  void numbers_unless(const Values& usual, std::string_view key, const Values& values, const Bounds&) {
    if (values != usual) numbers(key, values);
  }
  void identity(const auto& actuator, std::string_view) {
    text("name", actuator.name);
    if (!actuator.channel.empty()) text("channel", actuator.channel);
  }
  /// And its limits.
  void command(const LayoutThruster& thruster) {
    text("command", std::string(layout::row_of(thruster.unit).name));
    numbers("limits", std::array{thruster.low, thruster.high});
  }
  void hand(bool is_left) { line("hand", is_left ? "\"left\"" : "\"right\""); }
  void either(std::string_view, bool is_first, auto first, auto second) { is_first ? first() : second(); }
  void part(std::string_view key, bool is_there, auto members) {
    if (!is_there) return;
    const std::string name = fmt::format("{}.{}", name_, key);
    table(fmt::format("[{}]", name), name);
    members(*this);
    name_.resize(name_.size() - key.size() - 1);
  }
  template <class Part>
  void part(std::string_view key, const std::optional<Part>& value, auto members) {
    part(key, value.has_value(), [&](LayoutText& text) { members(text, *value); });
  }
  void require(std::string_view, std::string_view) {}
  void matrix(std::string_view key, const LayoutMatrix& values, const Bounds&, bool = false) {
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

}  // namespace

std::string layout_file(const Layout& vehicle) {
  LayoutText text(vehicle);
  text.table("# Layout of a vehicle (docs/vehicles.md): navcal vehicle check FILE.", "");
  text.text("name", vehicle.name);
  text.table("[water]", "water");
  text.number("density_kg_m3", vehicle.water_density_kg_m3);
  write_body(text, vehicle.body);
  text.table("[added_mass]", "added_mass");
  layout::go_through(text, vehicle.added_mass);
  text.table("[damping]", "damping");
  layout::go_through(text, vehicle.damping);
  layout::for_each_kind(vehicle, [&](std::string_view key, const auto& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      text.table(fmt::format("[[{}]]", key), fmt::format("{}[{}]", key, i + 1));
      layout::go_through(text, list[i]);
    }
  });
  return text.take().substr(1);
}

}  // namespace navcal::config

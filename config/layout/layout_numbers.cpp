// SPDX-License-Identifier: Apache-2.0
#include "config/layout/layout_numbers.h"

#include <fmt/format.h>

#include "base/angles.h"
#include "config/layout/members.h"

namespace navcal::config {
namespace {

using layout::Bounds;

/// Looks for one key of a layout; a fit asks thousands of times.
class NumberTable {
 public:
  static constexpr bool kReads = false;
  /// `wanted`: the key within this table.
  NumberTable(std::string_view wanted, std::optional<LayoutNumbers>& found) : wanted_(wanted), found_(found) {}

  void number(std::string_view key, double& value, const Bounds& bounds) {
    add(key, bounds, {&value, 1, 1, bounds.true_unit, bounds.low >= 0, false});
  }
  void angle(std::string_view key, double& value_rad, const Bounds& bounds) {
    add(key, bounds, {&value_rad, 1, base::kRadiansPerDegree, bounds.true_unit, bounds.low >= 0, false});
  }
  template <std::size_t N>
  void numbers(std::string_view key, std::array<double, N>& values, const Bounds& bounds) {
    add(key, bounds, {values.data(), N, 1, bounds.true_unit, false, false});
  }
  void matrix(std::string_view key, LayoutMatrix& values, const Bounds& bounds, bool is_symmetric = false) {
    add(key, bounds, {values.data(), values.size(), 1, bounds.true_unit, false, is_symmetric});
  }
  void direction(std::string_view key, LayoutVector& value, bool is_setting = false) {
    if (!is_setting) numbers(key, value, {-1, 1});
  }
  void either(std::string_view, bool, auto first, auto second) {
    first();
    second();
  }
  void part(std::string_view key, bool, auto members) {
    if (!wanted_.starts_with(key) || !wanted_.substr(key.size()).starts_with('.')) return;
    NumberTable table(wanted_.substr(key.size() + 1), found_);
    members(table);
  }
  template <class Part>
  void part(std::string_view key, std::optional<Part>& value, auto members) {
    if (value) part(key, true, [&](NumberTable& table) { members(table, *value); });
  }
  // No parameters that could be fitted.
  void number_unless(double, std::string_view, double&, const Bounds&) {}
  void angle_unless(double, std::string_view, double&, const Bounds&) {}
  void numbers_unless(const auto&, std::string_view, auto&, const Bounds&) {}
  void list(std::string_view, std::vector<double>&, const Bounds&) {}
  void limits(std::string_view, double&, double&, const Bounds&) {}
  void strips(LayoutStrips&) {}
  void identity(auto&, std::string_view) {}
  void command(LayoutThruster&) {}
  void hand(bool&) {}
  void require(std::string_view, std::string_view) {}

 private:
  void add(std::string_view key, const Bounds& bounds, const LayoutNumbers& numbers) {
    if (!bounds.is_setting && wanted_ == key) found_ = numbers;
  }

  std::string_view wanted_;
  std::optional<LayoutNumbers>& found_;
};

}  // namespace

std::optional<LayoutNumbers> find_numbers(Layout& vehicle, std::string_view key) {
  std::optional<LayoutNumbers> found;
  NumberTable whole(key, found);
  whole.part("water", true, [&](NumberTable& water) {
    water.number("density_kg_m3", vehicle.water_density_kg_m3, {-1, 1, "kg/m3"});
  });
  whole.part("body", true, [&](NumberTable& body) {
    body.number("mass_kg", vehicle.body.mass_kg, {0, 1, "kg"});
    body.numbers("gravity_centre_m", vehicle.body.gravity_centre_m, layout::kPlace);
    body.numbers("buoyancy_centre_m", vehicle.body.buoyancy_centre_m, layout::kPlace);
    body.numbers("inertia_kg_m2", vehicle.body.inertia_kg_m2, {-1, 1, "kg m2"});
    if (vehicle.body.volume_m3 > 0) {
      body.number("volume_m3", vehicle.body.volume_m3, {0, 1, "m3"});
    } else if (!vehicle.body.is_neutral) {
      body.number("buoyancy_N", vehicle.body.buoyancy_N, {0, 1, "N"});
    }
  });
  whole.part("added_mass", true, [&](auto& part) { layout::go_through(part, vehicle.added_mass); });
  whole.part("damping", true, [&](auto& part) { layout::go_through(part, vehicle.damping); });
  layout::for_each_kind(vehicle, [&](std::string_view kind, auto& list) {
    if (!key.starts_with(kind)) return;
    for (std::size_t i = 0; i < list.size(); ++i)
      whole.part(fmt::format("{}[{}]", kind, i + 1), true, [&](auto& part) { layout::go_through(part, list[i]); });
  });
  return found;
}

}  // namespace navcal::config

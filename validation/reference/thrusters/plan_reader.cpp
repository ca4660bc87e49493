// SPDX-License-Identifier: Apache-2.0
// The layout's text, read apart from config/layout: of both readers only docs/vehicles.md is the measure.
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "validation/reference/thrusters/plan.h"

namespace navcal::reference::thrusters {
namespace {

constexpr double kLargestNumber = 1e9;

/// One table of the file, with the name by which complaints call it.
class Part {
 public:
  Part(const toml::table& table, std::string name) : table_(table), name_(std::move(name)) {}

  [[noreturn]] void refuse(std::string_view key, const std::string& why) const {
    throw std::invalid_argument("layout: " + name_ + "." + std::string(key) + ": " + why);
  }
  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }
  [[nodiscard]] double number(std::string_view key, double otherwise) const {
    return has(key) ? finite(key, *table_.get(key)) : otherwise;
  }
  [[nodiscard]] double number(std::string_view key) const {
    if (!has(key)) refuse(key, "is missing");
    return number(key, 0);
  }
  [[nodiscard]] std::string text(std::string_view key, std::string otherwise) const {
    if (!has(key)) return otherwise;
    const auto given = table_[key].value<std::string>();
    if (!given) refuse(key, "is no text");
    return *given;
  }
  /// A list, or one number as a list of one.
  [[nodiscard]] std::vector<double> list(std::string_view key) const {
    std::vector<double> numbers;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return numbers;
    const toml::array* array = node->as_array();
    if (array == nullptr) return {finite(key, *node)};
    for (const toml::node& element : *array) numbers.push_back(finite(key, element));
    return numbers;
  }
  [[nodiscard]] Vector3 vector(std::string_view key, const Vector3& otherwise) const {
    if (!has(key)) return otherwise;
    const std::vector<double> numbers = list(key);
    if (numbers.size() != 3) refuse(key, "has not three numbers");
    return {numbers[0], numbers[1], numbers[2]};
  }
  [[nodiscard]] Vector3 direction(std::string_view key) const {
    const Vector3 given = vector(key, Vector3::Zero());
    if (given.norm() < 1e-6) refuse(key, "has no direction");
    return given.normalized();
  }
  /// Six numbers are a diagonal, 36 the rows.
  [[nodiscard]] Matrix6 matrix(std::string_view key) const {
    Matrix6 M = Matrix6::Zero();
    const std::vector<double> numbers = list(key);
    if (numbers.size() == 6) {
      for (int i = 0; i < 6; ++i) M(i, i) = numbers[static_cast<std::size_t>(i)];
    } else if (numbers.size() == 36) {
      for (int i = 0; i < 36; ++i) M(i / 6, i % 6) = numbers[static_cast<std::size_t>(i)];
    } else if (!numbers.empty()) {
      refuse(key, "has neither 6 nor 36 numbers");
    }
    return M;
  }
  [[nodiscard]] std::optional<Part> below(std::string_view key) const {
    if (!has(key)) return std::nullopt;
    const toml::table* table = table_[key].as_table();
    if (table == nullptr) refuse(key, "is no table");
    return Part(*table, name_ + "." + std::string(key));
  }

 private:
  [[nodiscard]] double finite(std::string_view key, const toml::node& node) const {
    const auto value = node.value<double>();
    if (!value) refuse(key, "is no number");
    if (!std::isfinite(*value) || std::abs(*value) > kLargestNumber) refuse(key, "is out of all bounds");
    return *value;
  }

  const toml::table& table_;
  std::string name_;
};

std::vector<Slice> slices_of(const Part& part) {
  const std::vector<double> x = part.list("x_m"), length = part.list("length_m"), width = part.list("width_m");
  const std::vector<double> height = part.has("height_m") ? part.list("height_m") : width;
  const auto nth = [&](std::string_view key, const std::vector<double>& list, std::size_t i) {
    if (list.size() != 1 && list.size() != x.size()) part.refuse(key, "has not one number for each of x_m");
    return list.size() == 1 ? list.front() : list[i];
  };
  std::vector<Slice> slices;
  for (std::size_t i = 0; i < x.size(); ++i)
    slices.push_back({x[i], nth("length_m", length, i), nth("width_m", width, i), nth("height_m", height, i)});
  return slices;
}

/// Lamb, Hydrodynamics, art. 114 and 115, by the integrals of the ellipsoid in closed form.
Matrix6 spheroid(double length_m, double diameter_m, double density_kg_m3) {
  const double a2 = length_m * length_m / 4, b2 = diameter_m * diameter_m / 4;
  const double e = std::sqrt(1 - b2 / a2);
  const double half_logarithm = std::atanh(e);
  const double alpha = 2 * (1 - e * e) / (e * e * e) * (half_logarithm - e);
  const double beta = 1 / (e * e) - (1 - e * e) / (e * e * e) * half_logarithm;
  const double displaced = density_kg_m3 * 4 / 3 * std::numbers::pi * std::sqrt(a2) * b2;
  const double turning =
      displaced / 5 * (a2 - b2) * (a2 - b2) * (beta - alpha) / (2 * (a2 - b2) + (a2 + b2) * (alpha - beta));
  Matrix6 M = Matrix6::Zero();
  const double across = displaced * beta / (2 - beta);
  M.diagonal() << displaced * alpha / (2 - alpha), across, across, 0, turning, turning;
  return M;
}

Matrix6 added_by_slices(const std::vector<Slice>& slices, double density_kg_m3) {
  Matrix6 M = Matrix6::Zero();
  for (const Slice& slice : slices) {
    const double round = density_kg_m3 * std::numbers::pi / 4 * slice.length_m;
    Vector6 sway = Vector6::Zero(), heave = Vector6::Zero();
    sway(1) = 1, sway(5) = slice.x_m;
    heave(2) = 1, heave(4) = -slice.x_m;
    M += round * slice.height_m * slice.height_m * sway * sway.transpose();
    M += round * slice.width_m * slice.width_m * heave * heave.transpose();
  }
  return M;
}

void read_body(const Part& body, Plan& plan) {
  plan.mass_kg = body.number("mass_kg");
  if (!(plan.mass_kg > 0)) body.refuse("mass_kg", "is not positive");
  plan.gravity_centre_m = body.vector("gravity_centre_m", Vector3::Zero());
  plan.buoyancy_centre_m = body.vector("buoyancy_centre_m", Vector3::Zero());
  plan.size_m = body.vector("size_m", Vector3::Zero());
  std::vector<double> I = body.list("inertia_kg_m2");
  if (I.size() == 3) I.resize(6);
  if (I.size() != 6) body.refuse("inertia_kg_m2", "has neither 3 nor 6 numbers");
  plan.inertia_kg_m2 << I[0], I[3], I[4], I[3], I[1], I[5], I[4], I[5], I[2];
  if (body.text("inertia_about", "gravity") == "origin") {
    const Vector3& r = plan.gravity_centre_m;
    plan.inertia_kg_m2 -=
        plan.mass_kg * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose()).eval();
  }
  plan.buoyancy_N = plan.mass_kg * kGravity_m_s2;
  if (body.has("buoyancy_N")) plan.buoyancy_N = body.number("buoyancy_N");
  if (body.has("volume_m3")) plan.buoyancy_N = plan.density_kg_m3 * kGravity_m_s2 * body.number("volume_m3");
}

void read_added_mass(const Part& added, Plan& plan) {
  plan.added_mass = added.matrix("matrix");
  if (const auto shape = added.below("spheroid")) {
    const double length_m = shape->number("length_m"), diameter_m = shape->number("diameter_m");
    if (!(diameter_m > 0 && diameter_m < length_m)) shape->refuse("diameter_m", "is not between 0 and the length");
    plan.added_mass += spheroid(length_m, diameter_m, plan.density_kg_m3);
  }
  if (const auto strips = added.below("strips"))
    plan.added_mass += added_by_slices(slices_of(*strips), plan.density_kg_m3);
}

void read_damping(const Part& damping, Plan& plan) {
  if (damping.has("flow_axes")) damping.refuse("flow_axes", "is a glider's, which this reality does not have");
  plan.linear = damping.matrix("linear");
  plan.quadratic = damping.matrix("quadratic");
  plan.lift = damping.matrix("lift");
  const double half_density = plan.density_kg_m3 / 2;
  if (const auto axial = damping.below("axial"))
    plan.axial_kg_m = half_density * axial->number("coefficient") * axial->number("area_m2");
  if (const auto lift = damping.below("body_lift")) {
    plan.body_lift_kg_m = half_density * lift->number("slope_per_rad") * lift->number("area_m2");
    plan.body_lift_m = lift->number("at_m", 0);
  }
  if (const auto across = damping.below("cross_flow")) {
    plan.crossflow = across->number("coefficient");
    plan.slices = slices_of(*across);
  }
}

void read_force(const Part& part, PlannedThruster& thruster) {
  if (part.has("diameter_m")) {
    thruster.diameter_m = part.number("diameter_m");
    thruster.KT = part.list("KT");
    thruster.KQ = part.list("KQ");
    if (thruster.KT.empty()) part.refuse("KT", "is missing");
    if (!(thruster.diameter_m > 0)) part.refuse("diameter_m", "is not positive");
    if (thruster.unit != OrderUnit::rpm) part.refuse("command", "a propeller takes rpm");
    return;
  }
  thruster.command = part.list("table_command");
  thruster.force_N = part.list("table_force_N");
  thruster.advance_loss = part.number("advance_loss_sqrtN_s_m", 0);
  thruster.torque_arm_m = part.number("torque_m", 0);
  const auto& x = thruster.command;
  if (x.size() < 2 || x.size() != thruster.force_N.size())
    part.refuse("table_force_N", "has not two or more forces, one for each command");
  if (std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) != x.end())
    part.refuse("table_command", "does not increase");
}

PlannedThruster thruster_of(const Part& part) {
  PlannedThruster thruster;
  thruster.name = part.text("name", "");
  thruster.place_m = part.vector("place_m", Vector3::Zero());
  thruster.direction = part.direction("direction");
  const std::string unit = part.text("command", "");
  if (unit == "rpm") {
    thruster.unit = OrderUnit::rpm;
  } else if (unit == "us") {
    thruster.unit = OrderUnit::microseconds;
    thruster.low = 1100;
    thruster.high = 1900;
  } else if (unit != "percent") {
    part.refuse("command", "is none of rpm, percent, us");
  }
  const std::vector<double> limits = part.list("limits");
  if (limits.size() == 2) {
    thruster.low = limits[0];
    thruster.high = limits[1];
  } else if (!limits.empty() || thruster.unit == OrderUnit::rpm) {
    part.refuse("limits", "has not two numbers");
  }
  if (!(thruster.low < thruster.high && thruster.low <= thruster.neutral() && thruster.neutral() <= thruster.high))
    part.refuse("limits", "do not hold the neutral command");
  read_force(part, thruster);
  thruster.reverse_efficiency = part.number("reverse_efficiency", 1);
  thruster.torque_share = part.number("torque_share", 1);
  thruster.reaction_sign = part.text("hand", "right") == "left" ? 1 : -1;
  thruster.dead_band = part.number("dead_band", 0);
  thruster.lag_s = part.number("lag_s", 0.1);
  if (!(thruster.lag_s > 0)) part.refuse("lag_s", "is not positive");
  return thruster;
}

Plan plan_of_table(const toml::table& file) {
  const Part whole(file, "file");
  for (const char* const other : {"surface", "ballast", "moving_mass"}) {
    if (file.contains(other)) whole.refuse(other, "this reality has thrusters only");
  }
  Plan plan;
  plan.name = whole.text("name", "");
  if (const auto water = whole.below("water")) plan.density_kg_m3 = water->number("density_kg_m3", 1000);
  const auto body = whole.below("body");
  if (!body) whole.refuse("body", "is missing");
  read_body(*body, plan);
  if (const auto added = whole.below("added_mass")) read_added_mass(*added, plan);
  if (const auto damping = whole.below("damping")) read_damping(*damping, plan);
  const toml::array* thrusters = file.get_as<toml::array>("thruster");
  if (thrusters == nullptr || thrusters->empty()) whole.refuse("thruster", "there is none");
  for (const toml::node& node : *thrusters) {
    const std::string name = "thruster[" + std::to_string(plan.thrusters.size() + 1) + "]";
    if (!node.is_table()) whole.refuse(name, "is no table");
    plan.thrusters.push_back(thruster_of(Part(*node.as_table(), name)));
  }
  return plan;
}

}  // namespace

Plan plan_of(std::string_view toml) {
  try {
    return plan_of_table(toml::parse(toml));
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument("layout: line " + std::to_string(error.source().begin.line) + ": " +
                                std::string(error.description()));
  }
}

}  // namespace navcal::reference::thrusters

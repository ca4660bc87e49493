// SPDX-License-Identifier: Apache-2.0
#include "config/layout/layout_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace navcal::config::layout {
namespace {

std::string of_bounds(const Bounds& bounds) {
  return fmt::format("{} to {}{}{}", bounds.low, bounds.high, bounds.unit.empty() ? "" : " ", bounds.unit);
}

/// One table in place of an array of tables is the first of the array.
std::string name_of_table(const Node& table) {
  const bool is_single = table.name == "thruster" || table.name == "surface" || table.name == "ballast" ||
                         table.name == "moving_mass";
  return is_single ? table.name + "[1]" : table.name;
}

}  // namespace

LayoutTable::LayoutTable(const Node& table, Layout& layout, std::vector<Problem>& problems)
    : table_(table), layout_(layout), problems_(problems), name_(name_of_table(table)), reader_(table, problems) {
  if (auto source = reader_.text("source")) layout_.sources.push_back({name_, std::move(*source)});
}

const std::vector<double>* LayoutTable::values_of(std::string_view key, std::string_view wanted) {
  const Node* node = reader_.find(key);
  if (node == nullptr) return nullptr;
  const auto* values = std::get_if<std::vector<double>>(&node->value);
  if (values == nullptr || node->is_list)
    reader_.complain(key, fmt::format("{} is expected, not {}", wanted,
                                      node->is_list ? "an array of tables" : words_for(node->value)));
  return node->is_list ? nullptr : values;
}

bool LayoutTable::are_within(std::string_view key, const std::vector<double>& values, const Bounds& bounds) {
  // Written so that NaN is outside.
  const auto outside = std::find_if(values.begin(), values.end(),
                                    [&](double value) { return !(value >= bounds.low && value <= bounds.high); });
  if (outside == values.end()) return true;
  reader_.complain(key, fmt::format("number {} of it, {}, is out of range: {}", outside - values.begin() + 1,
                                    *outside, of_bounds(bounds)));
  return false;
}

void LayoutTable::uncertainty(std::string_view key, const Bounds& bounds, std::size_t count) {
  LayoutUncertainty about;
  about.key = name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
  const std::string std_key = fmt::format("{}_std", key), range_key = fmt::format("{}_range", key);
  // Asked for only where they stand: messages about unknown keys list what was asked for.
  const auto stands = [&](const std::string& name) {
    return std::ranges::any_of(table_.children, [&](const Node& child) { return child.key == name; });
  };
  const Bounds of_std{0, bounds.high - bounds.low, bounds.unit};
  if (stands(std_key)) {
    const Node* node = reader_.find(std_key);
    const auto* each = std::get_if<std::vector<double>>(&node->value);
    if (count == 1 || each == nullptr || node->is_list) {
      about.std = reader_.number(std_key, of_std.low, of_std.high, of_std.unit);
    } else if (each->size() != count && !(count == 36 && each->size() == 6)) {
      reader_.complain(std_key, fmt::format("one number or {} are expected, as many as {} has, not {}", count, key,
                                            each->size()));
    } else if (are_within(std_key, *each, of_std)) {
      about.stds = *each;
    }
  }
  const auto* range = stands(range_key) ? values_of(range_key, "[LOW, HIGH]") : nullptr;
  if (range != nullptr) {
    if (range->size() != 2 || !((*range)[0] <= (*range)[1])) {
      reader_.complain(range_key, "[LOW, HIGH] is expected, the first not above the second");
    } else if (are_within(range_key, *range, bounds)) {
      about.range = {(*range)[0], (*range)[1]};
    }
  }
  if (about.std || !about.stds.empty() || about.range) layout_.uncertainties.push_back(std::move(about));
}

void LayoutTable::number(std::string_view key, double& value, const Bounds& bounds) {
  if (const auto given = reader_.number(key, bounds.low, bounds.high, bounds.unit)) value = *given;
  uncertainty(key, bounds);
}

void LayoutTable::angle(std::string_view key, double& value_rad, const Bounds& bounds_deg) {
  double degrees = value_rad * base::kDegreesPerRadian;
  if (!reader_.has(key)) return uncertainty(key, bounds_deg);
  number(key, degrees, bounds_deg);
  value_rad = degrees * base::kRadiansPerDegree;
}

void LayoutTable::numbers(std::string_view key, double* values, std::size_t count, const Bounds& bounds) {
  const std::string wanted = fmt::format("an array of {} numbers ({})", count, of_bounds(bounds));
  if (const auto* given = values_of(key, wanted)) {
    if (given->size() != count) {
      reader_.complain(key, fmt::format("{} is expected, not {}", wanted, given->size()));
    } else if (are_within(key, *given, bounds)) {
      std::copy(given->begin(), given->end(), values);
    }
  }
  uncertainty(key, bounds, count);
}

void LayoutTable::list(std::string_view key, std::vector<double>& values, const Bounds& bounds) {
  const std::string wanted = fmt::format("an array of 1 to {} numbers ({})", kMaxPoints, of_bounds(bounds));
  const auto* given = values_of(key, wanted);
  if (given == nullptr) return;
  if (given->empty() || given->size() > kMaxPoints) {
    reader_.complain(key, fmt::format("{} is expected, not {}", wanted, given->size()));
  } else if (are_within(key, *given, bounds)) {
    values = *given;
  }
}

void LayoutTable::list_or_one(std::string_view key, std::vector<double>& values, std::size_t count,
                              const Bounds& bounds) {
  const Node* node = reader_.find(key);
  if (node == nullptr) return;
  if (!std::holds_alternative<std::vector<double>>(node->value)) {
    if (const auto one = reader_.number(key, bounds.low, bounds.high, bounds.unit)) values.assign(count, *one);
    return;
  }
  list(key, values, bounds);
  if (!values.empty() && values.size() != count)
    reader_.complain(key, fmt::format("{} numbers, but {} of x_m", values.size(), count));
}

void LayoutTable::matrix(std::string_view key, LayoutMatrix& values, const Bounds& bounds, bool) {
  const auto* given =
      values_of(key, fmt::format("a diagonal of 6 numbers, or 36 row by row ({})", of_bounds(bounds)));
  if (given != nullptr && given->size() != 6 && given->size() != 36) {
    reader_.complain(key, fmt::format("{} numbers; a diagonal has 6, a matrix row by row 36", given->size()));
  } else if (given != nullptr && are_within(key, *given, bounds)) {
    for (std::size_t i = 0; i < given->size(); ++i) values[given->size() == 6 ? 7 * i : i] = (*given)[i];
  }
  uncertainty(key, bounds, values.size());
}

void LayoutTable::direction(std::string_view key, LayoutVector& value, bool) {
  numbers(key, value, {-1000, 1000});
  if (!(std::hypot(value[0], value[1], value[2]) > 1e-9)) {
    reader_.complain(key, "has no direction: all its numbers are zero");
    value = {1, 0, 0};
  }
}

void LayoutTable::limits(std::string_view key, double& low, double& high, const Bounds& bounds) {
  std::array<double, 2> both{low, high};
  numbers(key, both, bounds);
  if (both[0] > both[1]) {
    reader_.complain(key, fmt::format("the lower limit, {}, is above the upper one, {}", both[0], both[1]));
    return;
  }
  low = both[0];
  high = both[1];
}

void LayoutTable::strips(LayoutStrips& strips) {
  constexpr Bounds kAlong{-100, 100, "m"}, kSize{0, 100, "m"};
  list("x_m", strips.x_m, kAlong);
  const std::size_t count = strips.x_m.size();
  list_or_one("length_m", strips.length_m, count, kSize);
  list_or_one("width_m", strips.width_m, count, kSize);
  list_or_one("height_m", strips.height_m, count, kSize);
  reader_.require("x_m", "places of the strips along the x axis");
  reader_.require("length_m", "length of each strip along the x axis, or one for all");
  reader_.require("width_m", "width of each strip, or one for all");
  if (!reader_.has("height_m")) strips.height_m = strips.width_m;
  if (strips.length_m.size() != count || strips.width_m.size() != count || strips.height_m.size() != count)
    strips = {};
}

const Node* LayoutTable::below(std::string_view key) {
  const Node* node = reader_.find(key);
  if (node == nullptr) return nullptr;
  if (!node->is_list && std::holds_alternative<Table>(node->value)) return node;
  reader_.complain(key, fmt::format("a table [{}] is expected", node->name));
  return nullptr;
}

void LayoutTable::read_identity(std::string& name, std::string& channel, bool needs_name) {
  if (auto given = reader_.text("name")) name = std::move(*given);
  bool is_taken = false;
  for_each_kind(layout_, [&](std::string_view, const auto& list) {
    for (const auto& actuator : list) is_taken = is_taken || actuator.name == name;
  });
  if (!name.empty() && is_taken)
    reader_.complain("name", fmt::format("\"{}\" is already the name of another actuator", name));
  if (auto given = reader_.text("channel")) channel = std::move(*given);
  if (needs_name) reader_.require("name", "a name of its own, such as \"port\"");
}

void LayoutTable::command(LayoutThruster& thruster) {
  const auto given = reader_.choice("command", {"rpm", "percent", "us"});
  reader_.require("command", "unit of the command: rpm, percent or us");
  const auto found =
      std::ranges::find_if(kCommandUnits, [&](const CommandUnitRow& row) { return row.name == given; });
  const CommandUnitRow& row = found != kCommandUnits.end() ? *found : kCommandUnits.front();
  thruster.unit = row.unit;
  thruster.low = row.low;
  thruster.high = row.high;
}

}  // namespace navcal::config::layout

// SPDX-License-Identifier: Apache-2.0
#include "identify/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "config/layout/layout_numbers.h"

namespace navcal::identify {
namespace {

constexpr std::array<std::string_view, 6> kDegreesOfFreedom{"surge", "sway", "heave", "roll", "pitch", "yaw"};
constexpr std::array<std::string_view, 6> kInertia{"xx", "yy", "zz", "xy", "xz", "yz"};
constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

std::string name_of(const std::string& key, const config::LayoutNumbers& numbers, std::size_t element) {
  if (numbers.count == 1) return key;
  if (numbers.count == 36) {
    const std::string_view row = kDegreesOfFreedom[element / 6], column = kDegreesOfFreedom[element % 6];
    return row == column ? fmt::format("{}.{}", key, row) : fmt::format("{}.{}_{}", key, row, column);
  }
  if (numbers.count == 6) return fmt::format("{}.{}", key, kInertia[element]);
  if (numbers.count == 3) return fmt::format("{}.{}", key, kAxes[element]);
  return fmt::format("{}.{}", key, element);
}

/// Standard error of one element; 0: exact.
double std_of(const config::LayoutUncertainty& about, const config::LayoutNumbers& numbers, std::size_t element) {
  if (!about.stds.empty()) {
    if (numbers.count == 36 && about.stds.size() == 6) return element % 7 == 0 ? about.stds[element / 7] : 0;
    return element < about.stds.size() ? about.stds[element] : 0;
  }
  if (numbers.count > 1 && numbers.values[element] == 0) return 0;
  if (about.std) return *about.std;
  return about.range ? (about.range->second - about.range->first) / std::sqrt(12.0) : 0;
}

Parameter parameter_of(const config::LayoutUncertainty& about, const config::LayoutNumbers& numbers,
                       std::size_t element, double std) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Parameter parameter{.name = name_of(about.key, numbers, element),
                      .unit = std::string(numbers.unit),
                      .prior = numbers.values[element] / numbers.per_file_unit,
                      .prior_std = std,
                      .low = numbers.is_positive ? 0 : -kInfinity,
                      .high = kInfinity,
                      .key = about.key,
                      .elements = {element}};
  if (about.range) {
    parameter.low = std::max(parameter.low, about.range->first);
    parameter.high = about.range->second;
  }
  // A mass, a length or a diagonal of damping that changes its sign is another vehicle.
  const bool is_of_diagonal = numbers.count == 36 && element % 7 == 0;
  const bool is_moment = about.key == "body.inertia_kg_m2" && element < 3;
  if (numbers.is_positive || is_moment || (is_of_diagonal && parameter.prior > 0)) {
    constexpr double kLeastPart = 0.01;
    parameter.low = std::max(parameter.low, kLeastPart * parameter.prior);
  }
  // Damping takes energy, also where the file states none.
  if (is_of_diagonal && about.key.starts_with("damping.")) parameter.low = std::max(parameter.low, 0.0);
  return parameter;
}

Eigen::VectorXd of_each(std::span<const Parameter> parameters, double Parameter::*member) {
  Eigen::VectorXd all(std::ssize(parameters));
  for (std::size_t i = 0; i < parameters.size(); ++i) all[static_cast<Eigen::Index>(i)] = parameters[i].*member;
  return all;
}

}  // namespace

std::vector<Parameter> uncertain_parameters(const config::Layout& layout) {
  config::Layout copy = layout;
  std::vector<Parameter> parameters;
  for (const config::LayoutUncertainty& about : layout.uncertainties) {
    const auto numbers = config::find_numbers(copy, about.key);
    if (!numbers) continue;
    for (std::size_t element = 0; element < numbers->count; ++element) {
      const double std = std_of(about, *numbers, element);
      if (!(std > 0)) continue;
      const std::size_t across = numbers->is_symmetric ? element % 6 * 6 + element / 6 : element;
      const bool is_shared = across != element && numbers->values[across] == numbers->values[element];
      if (is_shared && across < element) continue;
      parameters.push_back(parameter_of(about, *numbers, element, std));
      if (is_shared) parameters.back().elements.push_back(across);
    }
  }
  return parameters;
}

config::Layout with_values(config::Layout layout, std::span<const Parameter> parameters,
                           const Eigen::VectorXd& values) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto numbers = config::find_numbers(layout, parameters[i].key);
    if (!numbers) continue;
    for (const std::size_t element : parameters[i].elements)
      numbers->values[element] = values[static_cast<Eigen::Index>(i)] * numbers->per_file_unit;
  }
  layout.body.set_buoyancy(layout.water_density_kg_m3);
  // Effects act on the vehicle that the numbers make.
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double value = values[static_cast<Eigen::Index>(i)];
    if (parameters[i].change && value != 0) parameters[i].change(layout, value);
  }
  return layout;
}

config::Layout with_estimates(config::Layout layout, std::span<const Parameter> parameters,
                              const Eigen::VectorXd& values, const Eigen::VectorXd& stds) {
  layout = with_values(std::move(layout), parameters, values);
  for (config::LayoutUncertainty& about : layout.uncertainties) {
    const auto numbers = config::find_numbers(layout, about.key);
    if (!numbers) continue;
    std::vector<double> of_elements(numbers->count);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (parameters[i].key != about.key) continue;
      for (const std::size_t element : parameters[i].elements)
        of_elements[element] = stds[static_cast<Eigen::Index>(i)];
    }
    if (numbers->count == 1) {
      about.std = of_elements.front();
      continue;
    }
    about.std.reset();
    about.stds = std::move(of_elements);
    // The file states as many as it states numbers: moments of inertia may be three.
    const bool is_diagonal = numbers->count == 36 && [&] {
      for (std::size_t i = 0; i < 36; ++i)
        if (i % 7 != 0 && about.stds[i] > 0) return false;
      return true;
    }();
    if (!is_diagonal) continue;
    std::vector<double> diagonal;
    for (std::size_t i = 0; i < 36; i += 7) diagonal.push_back(about.stds[i]);
    about.stds = std::move(diagonal);
  }
  return layout;
}

Eigen::VectorXd prior_values(std::span<const Parameter> parameters) {
  return of_each(parameters, &Parameter::prior);
}

Eigen::VectorXd prior_stds(std::span<const Parameter> parameters) {
  return of_each(parameters, &Parameter::prior_std);
}

Eigen::VectorXd lower_bounds(std::span<const Parameter> parameters) {
  return of_each(parameters, &Parameter::low);
}

Eigen::VectorXd upper_bounds(std::span<const Parameter> parameters) {
  return of_each(parameters, &Parameter::high);
}

bool moves_actuators(const Parameter& parameter) {
  return parameter.is_of_actuator || parameter.key.ends_with(".lag_s") || parameter.key.ends_with(".dead_band") ||
         parameter.key.ends_with(".rate_N_s") || parameter.key.ends_with(".rate_m_s");
}

}  // namespace navcal::identify

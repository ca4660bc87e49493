// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/directions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace navcal::identify {
namespace {

constexpr double kTogether = 0.8, kNamedWith = 0.95;
constexpr double kEqual = 0.25;  ///< relative difference of errors that count as equal

/// Parameters of a covariance in scaled form.
struct Errors {
  std::span<const Parameter> parameters;
  const Eigen::VectorXd& values;
  Eigen::VectorXd stds;
  Eigen::MatrixXd correlation;

  [[nodiscard]] double rho(std::size_t i, std::size_t j) const {
    return correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  [[nodiscard]] double std(std::size_t i) const { return stds[static_cast<Eigen::Index>(i)]; }
  [[nodiscard]] double relative(std::size_t i) const {
    return std(i) / std::abs(values[static_cast<Eigen::Index>(i)]);
  }
  [[nodiscard]] bool is_told(std::size_t i) const { return std(i) <= kTold * parameters[i].prior_std; }
};

template <class Size>
bool are_equal(const std::vector<std::size_t>& group, Size size) {
  double least = size(group.front()), most = least;
  for (const std::size_t i : group) {
    least = std::min(least, size(i));
    most = std::max(most, size(i));
  }
  return std::isfinite(most) && most - least <= kEqual * most;
}

std::string words_for_pair(const Errors& errors, std::size_t i, std::size_t j, const std::string& names) {
  const bool same_sign = errors.rho(i, j) > 0;
  const auto std_of = [&](std::size_t k) { return errors.std(k); };
  const auto relative_of = [&](std::size_t k) { return errors.relative(k); };
  if (errors.parameters[i].unit == errors.parameters[j].unit && are_equal({i, j}, std_of))
    return fmt::format("{}: only their {}", names, same_sign ? "difference" : "sum");
  if (are_equal({i, j}, relative_of))
    return fmt::format("{}: only their {}", names, same_sign ? "ratio" : "product");
  const double a = 1 / errors.std(i), b = (same_sign ? -1 : 1) / errors.std(j);
  const double size = std::hypot(a, b);
  return fmt::format("{}: only {:.3g} times the first {} {:.3g} times the second", names, a / size,
                     b < 0 ? "less" : "plus", std::abs(b) / size);
}

std::string words_for(const Errors& errors, const std::vector<std::size_t>& group) {
  std::vector<std::string> names;
  for (const std::size_t i : group) names.push_back(errors.parameters[i].name);
  if (group.size() == 1) {
    const std::size_t i = group.front();
    return fmt::format("{}: the recordings do not tell it (standard error {:.3g} before, {:.3g} after)", names[0],
                       errors.parameters[i].prior_std, errors.std(i));
  }
  const std::string last = names.back();
  names.pop_back();
  const std::string list = fmt::format("{} and {}", fmt::join(names, ", "), last);
  if (group.size() == 2) return words_for_pair(errors, group[0], group[1], list);
  const auto relative_of = [&](std::size_t k) { return errors.relative(k); };
  const bool go_together = std::ranges::all_of(group, [&](std::size_t i) {
    const auto at = [&](std::size_t k) { return errors.values[static_cast<Eigen::Index>(k)]; };
    return errors.rho(group[0], i) * at(group[0]) * at(i) > 0;
  });
  if (go_together && are_equal(group, relative_of))
    return list + ": only their ratios, their common scale is not told";
  return list + ": only combinations of them";
}

}  // namespace

std::vector<Direction> untold_directions(std::span<const Parameter> parameters, const Eigen::VectorXd& values,
                                         const Eigen::MatrixXd& covariance) {
  Errors errors{parameters, values, covariance.diagonal().cwiseSqrt(), {}};
  const Eigen::VectorXd scale = errors.stds.cwiseInverse();
  errors.correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  std::vector<Direction> directions;
  std::vector<bool> taken(parameters.size());
  for (std::size_t first = 0; first < parameters.size(); ++first) {
    if (taken[first] || errors.is_told(first)) continue;
    Direction direction{{first}, {}};
    taken[first] = true;
    // The group grows while it is walked through.
    for (std::size_t k = 0; k < direction.parameters.size(); ++k) {
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        const double rho = std::abs(errors.rho(direction.parameters[k], i));
        if (taken[i] || rho < (errors.is_told(i) ? kNamedWith : kTogether)) continue;
        taken[i] = true;
        direction.parameters.push_back(i);
      }
    }
    std::ranges::sort(direction.parameters);
    direction.words = words_for(errors, direction.parameters);
    directions.push_back(std::move(direction));
  }
  return directions;
}

}  // namespace navcal::identify

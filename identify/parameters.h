// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/layout.h"

namespace navcal::identify {

/// A parameter of an effect on the instruments (sim/effects/library), by its place in the effect's description.
struct InstrumentNumber {
  std::string_view effect;
  std::size_t parameter;
};

/// One uncertain number of a layout: what its file states a standard error or a range of. The prior is normal,
/// with the file's value as its mean. A range [low, high] without a standard error counts as a uniform
/// distribution, whose standard deviation is (high - low)/sqrt(12).
struct Parameter {
  /// "body.mass_kg", "damping.linear.surge", "thruster[2].lag_s", "body.gravity_centre_m.z".
  std::string name = {};
  std::string unit = {};  ///< of the file; empty: none
  double prior = 0, prior_std = 0;
  double low = 0, high = 0;                ///< bounds of the estimate
  std::string key = {};                    ///< of the file
  std::vector<std::size_t> elements = {};  ///< in the array of the key; two for an element of a symmetric matrix
  /// Changes the layout by a value in another way than by its numbers (an effect); the key is then empty.
  std::function<void(config::Layout&, double)> change = {};
  bool is_of_actuator = false;  ///< such a change
  /// An error of the instruments in place of a number of the layout; the key is then empty.
  std::optional<InstrumentNumber> of_instruments = {};
  double step = 0;  ///< of a finite difference; 0: a small part of the prior's standard deviation
};

/// All uncertain numbers, in the order of the file. A standard error of zero means that a number is exact.
[[nodiscard]] std::vector<Parameter> uncertain_parameters(const config::Layout& layout);

/// The layout with these values of the parameters, in their units; buoyancy follows mass or volume where the file
/// says so.
[[nodiscard]] config::Layout with_values(config::Layout layout, std::span<const Parameter> parameters,
                                         const Eigen::VectorXd& values);

/// The same with these standard errors as the layout's uncertainties, in place of those of the parameters.
[[nodiscard]] config::Layout with_estimates(config::Layout layout, std::span<const Parameter> parameters,
                                            const Eigen::VectorXd& values, const Eigen::VectorXd& stds);

[[nodiscard]] Eigen::VectorXd prior_values(std::span<const Parameter> parameters);
[[nodiscard]] Eigen::VectorXd prior_stds(std::span<const Parameter> parameters);
[[nodiscard]] Eigen::VectorXd lower_bounds(std::span<const Parameter> parameters);
[[nodiscard]] Eigen::VectorXd upper_bounds(std::span<const Parameter> parameters);

/// Whether the position of an actuator depends on the parameter for given commands.
[[nodiscard]] bool moves_actuators(const Parameter& parameter);

}  // namespace navcal::identify

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "gap/replay/reported_channels.h"

namespace navcal::gap {

/// What residuals may follow.
[[nodiscard]] const std::vector<std::string_view>& regimes();

/// Where the root mean square of the whole channel stands among them.
[[nodiscard]] Eigen::Index overall_regime();

/// The course's driver of a regime; columns that act together (sine and cosine). Empty for a band of frequency.
[[nodiscard]] Eigen::MatrixXd drivers_of(std::size_t regime, const Trajectory10Hz& course);

/// channels x regimes: root mean square of that part of a channel which follows the regime, in the channel's unit.
[[nodiscard]] Eigen::MatrixXd explained_rms(const Innovations& innovations, const Trajectory10Hz& course,
                                            const std::vector<double>& fix_times_s);

/// How much the null missions follow: from it the significance of what another does.
class RegimeStatistics {
 public:
  RegimeStatistics() = default;
  explicit RegimeStatistics(const std::vector<Eigen::MatrixXd>& of_nulls);

  /// Usual size among nulls.
  [[nodiscard]] double floor(Eigen::Index channel, Eigen::Index regime) const;
  /// Probability that a null shows as much in this cell; by a gamma distribution of the mean square, whose tail is
  /// taken as heavier than the bank can show.
  [[nodiscard]] double p_value(Eigen::Index channel, Eigen::Index regime, double value) const;

  Eigen::MatrixXd mean_square, variance;  ///< of the mean square, among nulls
};

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "gap/data/innovations.h"

namespace navcal::gap {

/// One channel of the answer: one or several innovations in one physical unit.
struct ReportedChannel {
  std::string_view name, unit;
  double per_si = 1;  ///< from SI to the unit
};
[[nodiscard]] const std::vector<ReportedChannel>& reported_channels();

/// Innovations of one reported channel: a column each, a row for each of `rows` of the course.
struct ChannelSeries {
  Eigen::MatrixXd values;
  std::vector<std::size_t> rows;
};
[[nodiscard]] ChannelSeries series_of(std::size_t channel, const Innovations& innovations,
                                      const Trajectory10Hz& course, const std::vector<double>& fix_times_s);

/// Means of blocks of `length` rows, repeated at each row.
[[nodiscard]] Eigen::MatrixXd block_means(const Eigen::MatrixXd& values, Eigen::Index length);

/// Names of the regimes: covariates that residuals may depend on, and bands of frequency.
[[nodiscard]] const std::vector<std::string_view>& regimes();

/// Index of the regime that is the root mean square of the whole channel.
[[nodiscard]] Eigen::Index overall_regime();

/// Covariates of a regime along the trajectory, one column each; sine and cosine act together. Empty for a band
/// of frequency.
[[nodiscard]] Eigen::MatrixXd drivers_of(std::size_t regime, const Trajectory10Hz& course);

/// channels x regimes: root mean square of the part of a channel that the regime explains, in the channel's
/// unit.
[[nodiscard]] Eigen::MatrixXd explained_rms(const Innovations& innovations, const Trajectory10Hz& course,
                                            const std::vector<double>& fix_times_s);

/// Statistics of explained_rms() over the null missions, for the significance of another mission's values.
class RegimeStatistics {
 public:
  RegimeStatistics() = default;
  explicit RegimeStatistics(const std::vector<Eigen::MatrixXd>& of_nulls);

  /// Root mean square among nulls.
  [[nodiscard]] double floor(Eigen::Index channel, Eigen::Index regime) const;
  /// Probability that a null has at least this value in the cell. Model: the mean square has a gamma
  /// distribution, with a heavier tail than the bank can resolve.
  [[nodiscard]] double p_value(Eigen::Index channel, Eigen::Index regime, double value) const;

  Eigen::MatrixXd mean_square;  ///< among nulls
  Eigen::MatrixXd variance;     ///< of the mean square; where nulls are few, its upper limit
};

}  // namespace navcal::gap

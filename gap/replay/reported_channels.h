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

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "gap/data/innovations.h"
#include "gap/replay/regimes.h"
#include "gap/verdict/diagnosis.h"

namespace navcal::gap {

/// Residual map: every channel by every regime. p-values hold over all cells together (Bonferroni). Largest
/// excess power first, in units of the power of the channel's noise.
[[nodiscard]] std::vector<WhereEntry> residual_map(const Eigen::MatrixXd& explained_rms,
                                                   const RegimeStatistics& nulls);
/// Cells of a map that are significant against the nulls, by p-value and by size (kSignificantBelow,
/// kLouderThanNulls).
[[nodiscard]] std::vector<WhereEntry> significant_cells(const std::vector<WhereEntry>& map);
/// Smallest ratio of a channel's root mean square to that of the nulls, over the channels that compare the motion
/// with the model of the vehicle: the others follow any vehicle. Empty where there are less than three of them.
[[nodiscard]] std::optional<double> least_ratio(const Eigen::MatrixXd& explained_rms,
                                                const RegimeStatistics& nulls);
/// Significant cells of the residuals `left` when all that was found is in the model. A cell must be
/// significant against vehicles whose parameters are known exactly (`known`). It must also exceed the rms of
/// vehicles whose tolerances are unknown (`nulls`).
[[nodiscard]] std::vector<WhereEntry> significant_against_exact_model(const Eigen::MatrixXd& left,
                                                                      const RegimeStatistics& known,
                                                                      const RegimeStatistics& nulls);
/// The cell of a non-empty map in which `after` lies below `before` by most, in units of the power of the
/// channel's noise. It is shown when no cell is significant by itself.
[[nodiscard]] WhereEntry most_changed(const std::vector<WhereEntry>& map, const Eigen::MatrixXd& before,
                                      const Eigen::MatrixXd& after, const RegimeStatistics& nulls);

/// Permanent and temporary changes of a channel's level in mid-mission (LevelChanges): one entry for each
/// change.
[[nodiscard]] std::vector<ChangePoint> change_points(const Innovations& innovations, const Trajectory10Hz& course,
                                                     const std::vector<double>& fix_times_s,
                                                     const RegimeStatistics& nulls);

/// Data of the page's figures.
[[nodiscard]] std::vector<Course> courses(const Innovations& before, const Innovations& after,
                                          const Trajectory10Hz& course, const std::vector<double>& fix_times_s);
[[nodiscard]] Scatter scatter(const WhereEntry& where, const Innovations& before, const Innovations& after,
                              const Trajectory10Hz& course, const std::vector<double>& fix_times_s);

}  // namespace navcal::gap

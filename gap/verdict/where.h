// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gap/data/innovations.h"
#include "gap/replay/regimes.h"
#include "gap/verdict/diagnosis.h"

namespace navcal::gap {

/// Every channel by every regime; p values hold over all of them together (Bonferroni). Strongest excess first, by
/// its power in that of the channel's noise.
[[nodiscard]] std::vector<WhereEntry> residual_map(const Eigen::MatrixXd& explained_rms,
                                                   const RegimeStatistics& nulls);
/// Those that nulls would hardly show, by their size either.
[[nodiscard]] std::vector<WhereEntry> significant_cells(const std::vector<WhereEntry>& map);
/// Of what is left with all that was found in the model: what no vehicle leaves whose every number is known
/// (`known`), and is more than tolerances alone make of vehicles without a gap, too.
[[nodiscard]] std::vector<WhereEntry> significant_against_exact_model(const Eigen::MatrixXd& left,
                                                                      const RegimeStatistics& known,
                                                                      const RegimeStatistics& nulls);
/// Of a map that is not empty, where `after` follows the regime less than `before` by most, in powers
/// of the channel's noise: what to look at when nothing stands clear of nulls by itself.
[[nodiscard]] WhereEntry most_changed(const std::vector<WhereEntry>& map, const Eigen::MatrixXd& before,
                                      const Eigen::MatrixXd& after, const RegimeStatistics& nulls);

/// Levels of channels that changed in mid-mission, for good or for a time (LevelChanges): one entry a change.
[[nodiscard]] std::vector<ChangePoint> change_points(const Innovations& innovations, const Trajectory10Hz& course,
                                                     const std::vector<double>& fix_times_s,
                                                     const RegimeStatistics& nulls);

/// For the pictures.
[[nodiscard]] std::vector<Course> courses(const Innovations& before, const Innovations& after,
                                          const Trajectory10Hz& course, const std::vector<double>& fix_times_s);
[[nodiscard]] Scatter scatter(const WhereEntry& where, const Innovations& before, const Innovations& after,
                              const Trajectory10Hz& course, const std::vector<double>& fix_times_s);

}  // namespace navcal::gap

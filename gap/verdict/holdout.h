// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/linearised.h"
#include "gap/verdict/prepare.h"

namespace navcal::gap {

/// Of whitened innovations.
struct Power {
  double mean_square = 0;
  std::vector<double> blocks;  ///< sums of squares of blocks of ten seconds
};

/// One mission before and after the effects that were found are in the model; only the gyros' biases are fitted
/// anew.
struct Comparison {
  Power before, after;
  double floor = 0, floor_std = 0;  ///< mean square of the mission's own nulls
  double measurements = 0;          ///< how many the means are over
  Innovations nominal, improved;
  Trajectory10Hz course;  ///< of the improved replay
  std::vector<double> fix_times_s;
  Eigen::VectorXd channel_floor;  ///< root mean square of each reported channel among the nulls
};

/// `effects`: values of all unknowns; their biases are not used.
[[nodiscard]] Comparison compare(const Prepared& mission, const Library& library, const Eigen::VectorXd& effects);

/// How well the parameters that another mission gave predict this one.
struct HeldOutPrediction {
  double gain_nats = 0;  ///< by how much its log likelihood is greater with the effects than without
  Power power;           ///< with them
};
/// By two sets of values of all unknowns; the gyros' biases are fitted anew for each.
[[nodiscard]] HeldOutPrediction predict_held_out(const ResidualModel& model, const Eigen::VectorXd& without,
                                                 const Eigen::VectorXd& with);

/// Of several missions together: 1 - (after - floor) / (before - floor), with its 95 % interval by a bootstrap of
/// the blocks and of what is known of the floors.
struct PooledClosure {
  double before = 0, after = 0, floor = 0;
  bool clear = false;  ///< the gap before stands clear of the floor
  double closed = 0, lower = 0, upper = 0;
};
/// By the effects alone.
[[nodiscard]] PooledClosure pooled_closure(const std::vector<Comparison>& comparisons);
/// By what left `after` of each mission.
[[nodiscard]] PooledClosure pooled_closure(const std::vector<Comparison>& comparisons,
                                           const std::vector<Power>& after);

}  // namespace navcal::gap

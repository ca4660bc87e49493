// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/linearised.h"
#include "gap/verdict/prepare.h"

namespace navcal::gap {

/// Power of whitened innovations.
struct Power {
  double mean_square = 0;
  std::vector<double> blocks;  ///< sums of squares of blocks of ten seconds
};

/// One mission without and with the effects found in the model; only the gyros' biases are fitted anew.
struct Comparison {
  Power before, after;
  double floor = 0, floor_std = 0;  ///< mean square of the mission's own nulls
  double measurements = 0;          ///< number of measurements behind the means
  Innovations nominal, improved;
  Trajectory10Hz course;  ///< of the improved replay
  std::vector<double> fix_times_s;
  Eigen::VectorXd channel_floor;  ///< root mean square of each reported channel among the nulls
};

/// Compares one mission without and with effects. `effects`: values of all unknowns; their biases are not used.
[[nodiscard]] Comparison compare(const Prepared& mission, const Library& library, const Eigen::VectorXd& effects);

/// Prediction of a mission with parameters fitted to another one.
struct HeldOutPrediction {
  double gain_nats = 0;  ///< log likelihood with the effects minus that without
  Power power;           ///< with them
};
/// Predicts a mission with two sets of values of all unknowns; the gyros' biases are fitted anew for each.
[[nodiscard]] HeldOutPrediction predict_held_out(const ResidualModel& model, const Eigen::VectorXd& without,
                                                 const Eigen::VectorXd& with);

/// Closure of several missions together: 1 - (after - floor) / (before - floor). Its 95 % interval comes from a
/// bootstrap of the blocks and of the floors' uncertainty.
struct PooledClosure {
  double before = 0, after = 0, floor = 0;
  bool clear = false;  ///< the gap before is significantly above the floor
  double closed = 0, lower = 0, upper = 0;
};
/// Closure with the effects alone in the model.
[[nodiscard]] PooledClosure pooled_closure(const std::vector<Comparison>& comparisons);
/// Closure with the power `after` of each mission instead.
[[nodiscard]] PooledClosure pooled_closure(const std::vector<Comparison>& comparisons,
                                           const std::vector<Power>& after);

}  // namespace navcal::gap

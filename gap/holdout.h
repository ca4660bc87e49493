#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/library.h"
#include "gap/null_bank.h"
#include "gap/replay.h"

namespace navcal::gap {

/// One mission before and after the effects that were found are in the model; only the gyros' biases are fitted
/// anew.
struct Comparison {
  double before = 0, after = 0;                     ///< mean square of whitened innovations
  double floor = 0, floor_std = 0;                  ///< of the mission's own nulls
  double measurements = 0;                          ///< how many the means are over
  std::vector<double> before_blocks, after_blocks;  ///< sums of squares of blocks of ten seconds
  Innovations nominal, improved;
  Course10Hz course;  ///< of the improved replay
  std::vector<double> fix_times_s;
  Eigen::VectorXd channel_floor;  ///< root mean square of each reported channel among the nulls
};

/// `nominal`: the values of all unknowns without effects, by with_biases_found().
[[nodiscard]] Comparison compare(const Replay& replay, const Library& library, const NullBank& bank,
                                 const Eigen::VectorXd& nominal, const Eigen::VectorXd& effects);

/// By how much a mission's log likelihood is greater with one set of values of all unknowns than with another,
/// nats; the gyros' biases are fitted anew for each.
[[nodiscard]] double gain_nats(const Replay& replay, const Library& library, const Whitening& whitening,
                               const Eigen::VectorXd& without, const Eigen::VectorXd& with);

/// Of several missions together: 1 - (after - floor) / (before - floor), with its 95 % interval by a bootstrap of
/// the blocks and of what is known of the floors.
struct PooledClosure {
  double before = 0, after = 0, floor = 0;
  bool clear = false;  ///< the gap before stands clear of the floor
  double closed = 0, lower = 0, upper = 0;
};
[[nodiscard]] PooledClosure pooled_closure(const std::vector<Comparison>& comparisons);

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace navcal::instruments {

/// What the delays behind the envelope look like, learnt block by block: their mean, whether they have the sharp
/// lower edge on which the envelope rests, and how far they reach.
class DelaySpread {
 public:
  /// Delays of mean `mean_s`, reaching over `range_s`, believed as much as `blocks` of them.
  void begin(double mean_s, double range_s, double blocks);
  /// Residuals of one block against the model, at least 4. Sorts them.
  void learn(std::span<double> residuals_s);

  /// Mean of exponential delays with the same lower edge.
  [[nodiscard]] double mean_s() const { return mean_s_; }
  /// Blocks that told the mean, up to the memory's length.
  [[nodiscard]] double weight() const { return weight_; }
  /// Distance of the residuals' middle from their lower edge, if that edge is soft; 0 if it is sharp, as of
  /// exponential delays. Residuals that lie on both sides alike come from a host that rounds its stamps, or from a
  /// device whose ticks are uneven: there the truth may lie anywhere among them.
  [[nodiscard]] double soft_edge_s() const { return soft_edge_s_; }
  /// From the earliest to the latest of a block, in the mean.
  [[nodiscard]] double range_s() const { return range_s_; }

 private:
  double mean_s_ = 1e-3;
  double weight_ = 0;
  double by_median_s_ = 1e-3;  ///< mean delay, by the median above the earliest
  double by_lowest_s_ = 1e-3;  ///< by the four lowest
  double below_s_ = 0;         ///< from the second lowest to the median
  double above_s_ = 0;         ///< from the median to the second highest
  double middle_s_ = 0;        ///< of the median from the earliest
  double range_s_ = 0;
  double shape_weight_ = 0;
  double soft_edge_s_ = 0;
};

}  // namespace navcal::instruments

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace navcal::instruments {

/// Distribution of the delays above the envelope, learnt block by block: mean, sharpness of the lower edge on
/// which the envelope rests, and range.
class DelaySpread {
 public:
  /// Begins with delays of mean `mean_s` and range `range_s`, with the weight of `blocks` blocks.
  void begin(double mean_s, double range_s, double blocks);
  /// Residuals of one block against the model, at least 4. Sorts them.
  void learn(std::span<double> residuals_s);

  /// Mean of exponential delays with the same lower edge.
  [[nodiscard]] double mean_s() const { return mean_s_; }
  /// Number of blocks in the mean, up to the memory's length.
  [[nodiscard]] double weight() const { return weight_; }
  /// Distance of the residuals' median from their lower edge if that edge is soft; 0 if it is sharp, as with
  /// exponential delays. Symmetric residuals come from a host that rounds its stamps, or from a device with
  /// uneven ticks. The true time may then lie anywhere among them.
  [[nodiscard]] double soft_edge_s() const { return soft_edge_s_; }
  /// Mean range within a block, from the earliest to the latest.
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "calib/turn/turn_filter.h"

namespace navcal::calib {

/// Turn filters for several walks of the gyro's bias, weighted by the probability that each gives the readings
/// (multiple-model estimation; Magill, IEEE Trans. Automatic Control 10, 1965). The walks are none, a tenth of
/// the one in the parameters, and that one. So a gyro with a constant bias is calibrated several times as well
/// as one that drifts, without a setting. The weights have a lower bound, so that a filter can recover when the
/// bias begins to drift.
class TurnFilterBank {
 public:
  explicit TurnFilterBank(const TurnFilter::Parameters& parameters,
                          const TurnPrior& prior = TurnPrior::unknown_both());

  void update(const TurnStep& step);

  /// Mean over the filters.
  [[nodiscard]] TurnCoefficients estimate() const;
  /// Covariance about that mean: each filter's own, and the scatter between the filters.
  [[nodiscard]] TurnCovariance covariance() const;
  // Values of the most probable filter, as in TurnFilter.
  [[nodiscard]] double condition() const { return best().condition(); }
  [[nodiscard]] double reduced_chi_squared() const { return best().reduced_chi_squared(); }
  [[nodiscard]] std::uint64_t readings() const { return filters_.front().readings(); }

  void archive(Archive& archive);

 private:
  static constexpr std::size_t kFilters = 3;

  [[nodiscard]] std::array<double, kFilters> weights() const;
  [[nodiscard]] const TurnFilter& best() const;

  std::array<TurnFilter, kFilters> filters_;
  std::array<double, kFilters> log_weights_;
};

}  // namespace navcal::calib

// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/telling_piece.h"

namespace navcal::gap {

double loudest_piece_s(const Eigen::VectorXd& residual, const Layout& layout,
                       const std::vector<double>& fix_times_s, double length_s) {
  const Eigen::Index grid = layout.intervals * kEvidenceChannels;
  // Power up to each interval.
  std::vector<double> power(static_cast<std::size_t>(layout.intervals) + 1, 0);
  for (Eigen::Index i = 0; i < layout.intervals; ++i) {
    power[static_cast<std::size_t>(i) + 1] =
        residual.segment(i * kEvidenceChannels, kEvidenceChannels).squaredNorm();
  }
  for (std::size_t i = 0; i < fix_times_s.size(); ++i) {
    const auto row = grid + static_cast<Eigen::Index>(i) * kFixChannels;
    const double place = fix_times_s[i] / kInterval_s;
    if (!(place >= 0) || place >= static_cast<double>(layout.intervals)) continue;
    power[static_cast<std::size_t>(place) + 1] += residual.segment(row, kFixChannels).squaredNorm();
  }
  for (std::size_t i = 1; i < power.size(); ++i) power[i] += power[i - 1];
  const auto length = static_cast<std::size_t>(length_s / kInterval_s);
  std::size_t best = 0;
  for (std::size_t from = 0; from + length < power.size(); ++from) {
    if (power[from + length] - power[from] > power[best + length] - power[best]) best = from;
  }
  return static_cast<double>(best) * kInterval_s;
}

}  // namespace navcal::gap

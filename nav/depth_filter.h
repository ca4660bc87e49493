// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "nav/options.h"

namespace navcal::nav {

/// Model: z' = predicted + e, e constant: depth by the speed and the pitch, corrected by the gauge with fixed
/// gains (an alpha-beta filter; Kalata, IEEE Trans. Aerospace and Electronic Systems 20, 1984). Metres, positive
/// down.
class DepthFilter {
 public:
  explicit DepthFilter(const DepthOptions& options) : options_(options) {}

  /// So long passed, during which it sank at this rate, as far as is known.
  void advance(double predicted_m_s, double duration_s);
  /// A reading with its standard error, if that is known.
  void correct(double depth_m, std::optional<double> std_m = std::nullopt);

  [[nodiscard]] const std::optional<double>& depth_m() const { return depth_m_; }
  /// Standard error of depth_m(): that of the newest reading, and what has come since. The gauge's own offset at
  /// the surface is not in it. Nullopt where the reading's is not known.
  [[nodiscard]] std::optional<double> std_m() const;
  [[nodiscard]] double sinking_m_s() const { return predicted_m_s_ + rate_error_m_s_; }

 private:
  DepthOptions options_;
  std::optional<double> depth_m_;
  std::optional<double> reading_std_m_;
  double rate_error_m_s_ = 0;
  double predicted_m_s_ = 0;
  double since_s_ = 0;  ///< since the last reading
};

}  // namespace navcal::nav

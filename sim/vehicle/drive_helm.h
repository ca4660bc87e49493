// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/path.h"
#include "sim/vehicle/helm.h"

namespace navcal::sim {

/// Moves fins and shaft as the rows of a path say, from the state in its first row; between rows in a straight
/// line, after the last as there.
class DriveHelm final : public Helm {
 public:
  /// Two rows or more, times increasing: what load_path() gives.
  explicit DriveHelm(std::vector<PathRow> rows);

  [[nodiscard]] Body start() const override;
  [[nodiscard]] Actuators actuators_at_start() const override;
  [[nodiscard]] Actuators next(double time_s, double step_s, const Body& body) override;
  /// True because the reference paths were made so.
  [[nodiscard]] bool holds_over_steps() const override { return true; }
  [[nodiscard]] bool finished() const override { return finished_; }

 private:
  std::vector<PathRow> rows_;
  std::size_t row_ = 0;  ///< at or before the time asked for last
  bool finished_ = false;
};

}  // namespace navcal::sim

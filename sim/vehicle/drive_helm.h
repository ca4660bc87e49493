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
  [[nodiscard]] ActuatorValues positions_at_start() const override;
  void next(double time_s, double step_s, const Body& body, Actuators& actuators) override;
  /// The reference paths were made so.
  [[nodiscard]] Positions positions() const override { return Positions::held; }
  [[nodiscard]] bool finished() const override { return finished_; }

 private:
  std::vector<PathRow> rows_;
  std::size_t row_ = 0;  ///< at or before the time asked for last
  bool finished_ = false;
};

}  // namespace navcal::sim

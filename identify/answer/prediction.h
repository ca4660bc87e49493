// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "config/layout.h"
#include "identify/data/recorded_motion.h"

namespace navcal::identify {

/// Ways to predict a motion from a measured state: the vehicle stands still; it holds its velocity and rates; the
/// layout moves under the recorded commands; accelerations by a regression on velocities, tilt and actuators, and
/// by one with squares and products as well.
inline constexpr std::array<std::string_view, 5> kPredictors{"still", "hold", "layout", "linear", "quadratic"};
enum class Predictor : std::size_t { still, hold, layout, linear, quadratic };

/// Root mean square errors so long after the starts, in the order of kPredictors; nullopt: not measured, or no
/// regression.
struct PredictionErrors {
  double after_s = 0;
  std::size_t starts = 0;
  using Row = std::array<std::optional<double>, kPredictors.size()>;
  Row position_m, heading_rad, depth_m, velocity_m_s;  ///< horizontal position, velocity of the body
};

struct PredictionRequest {
  config::Layout layout;
  std::vector<RecordedMotion> recordings;
  std::vector<RecordedMotion> fit;  ///< of the same vehicle, for the regressions; empty: none
  double every_s = 5;               ///< between starts
};

struct Prediction {
  std::array<PredictionErrors, 3> errors;  ///< after 1, 10 and 60 s
  /// Standing still is not three times worse than holding and the regression: errors after 10 and 60 s judge the
  /// vehicle's controller.
  bool is_steered = false;
  /// Error of the layout by which it is judged, and whether it is larger than that of the others: of the velocity
  /// after 1 s, m/s, where the vehicle is steered or no 10 s are measured; else of the position after 10 s, m.
  bool by_velocity = false;
  double layout_error = 0;
  bool worse_than_linear = false, worse_than_hold = false;
  std::size_t diverged = 0;  ///< starts from which the layout left all bounds; its last state counts
  bool by_fixes = false;     ///< position was measured; else it is the integral of the measured velocity
};

/// Open-loop predictions from the measured states of the recordings with their commands. Throws
/// std::invalid_argument in words where commands, heading or velocity are missing, or no second is measured.
[[nodiscard]] Prediction predict(const PredictionRequest& request, const std::function<void(double)>& progress);

}  // namespace navcal::identify

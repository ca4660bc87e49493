// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gap/data/mission.h"
#include "gap/verdict/diagnosis.h"
#include "gap/watch/change_detector.h"
#include "instruments/samples.h"

namespace navcal::gap {

struct WatchReport;

/// Length of the judged part of a window, s.
inline constexpr double kWindow_s = 30;

/// Residuals of one window as a linear function of all unknowns. What is new in each window (turn-on biases, the
/// current of the water) is integrated out of `gram` and `score`, so that a current which changes is no gap.
struct WindowEvidence {
  Eigen::MatrixXd gram;     ///< n x n, of all unknowns
  Eigen::VectorXd score;    ///< n
  double measurements = 0;  ///< number of whitened residuals
  Eigen::VectorXd power;    ///< of each channel: mean square of whitened residuals; NaN: not measured
};

/// The causes that a watch looks for in windows of one vehicle, and its expectation where nothing changes.
struct WatchModel {
  std::vector<WatchedCause> causes;
  Eigen::MatrixXd root;  ///< of the covariance of all unknowns without a change
  double noise_factor = 1, model_error = ChangeDetector::kModelError;
  PowerDetector power;                     ///< before its first window
  std::vector<std::string_view> channels;  ///< of the powers
  double settling_s = 0;                   ///< before the judged part, in which a window's estimator settles
  std::uint64_t most_looked_at = 0;        ///< windows behind an alarm, by look(); 0: the watch finds the causes
  int recordings = 0, windows = 0;         ///< without a gap, on which all this rests
};

/// A command to the motor card. Times are on the scale of the samples.
struct TimedOrder {
  std::int64_t time_ns = 0;
  Order order;
};

/// Makes evidence of the windows of one vehicle, one after the other.
class WindowSource {
 public:
  WindowSource() = default;
  WindowSource(const WindowSource&) = delete;
  WindowSource& operator=(const WindowSource&) = delete;
  virtual ~WindowSource() = default;

  [[nodiscard]] const WatchModel& model() const { return model_; }
  /// Takes what was measured from `begin_ns` on, in settling_s + kWindow_s. Empty: the window can be judged; else
  /// why not, and then nothing else may be called before the next one.
  [[nodiscard]] virtual std::string take(std::span<const instruments::Sample> samples,
                                         std::span<const TimedOrder> orders, std::int64_t begin_ns) = 0;
  /// That of the window taken. To be called once, before power_with().
  [[nodiscard]] virtual WindowEvidence evidence() = 0;
  /// Power of the channels with these values of all unknowns, what is new in the window fitted.
  [[nodiscard]] virtual Eigen::VectorXd power_with(const Eigen::VectorXd& values) = 0;
  /// Places at which the last so many windows depart, clearest first.
  [[nodiscard]] virtual std::vector<WhereEntry> where(std::uint64_t windows) const = 0;
  /// Writes the verdict and causes of several windows together, which were measured from `begin_ns` on.
  virtual void look(std::span<const instruments::Sample> /*samples*/, std::span<const TimedOrder> /*orders*/,
                    std::int64_t /*begin_ns*/, WatchReport& /*report*/) {}
  /// Vehicle and recordings without a gap in a word, equal where evidence of one source serves another.
  [[nodiscard]] virtual std::string identity() const = 0;
  /// Knowledge of this vehicle beside the evidence, to be kept over a restart.
  [[nodiscard]] virtual std::vector<double> learnt() const { return {}; }
  /// Throws std::invalid_argument for what another source has learnt.
  virtual void restore(const std::vector<double>& learnt) {
    if (!learnt.empty()) throw std::invalid_argument("the state is of another vehicle's windows");
  }

 protected:
  WatchModel model_;
};

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gap/thresholds.h"

namespace navcal::gap {

/// A cause that a watch looks for, as a change of some unknowns.
struct WatchedCause {
  std::string name;
  std::vector<Eigen::Index> columns;  ///< the unknowns
  Eigen::VectorXd typical;            ///< of each of them
  bool is_vector = false;             ///< its strength is the norm of its components, else the largest one
  double most = kLargestStrength;     ///< strength that it can have

  /// Strength of a change of its columns, in typical values.
  [[nodiscard]] double strength(const Eigen::VectorXd& change) const;
};

/// Sequential test whether one of several causes began at some window.
///
/// A Bayes factor compares two statements about all windows since an onset: "this effect changed at the onset" and
/// "nothing changed". If nothing changed, and tolerances and noise are those of the null missions, its expectation
/// is 1 at any time. The statistic is the sum over onsets of the mean over effects: the Shiryaev-Roberts
/// statistic, whose expectation after n windows is at most n without a change. The first time at which it exceeds
/// c is therefore after c windows on average, or later (Pollak 1985; e-detectors, Shin, Ramdas and Rinaldo 2023).
/// Onsets are thinned out with their age, which only lowers the statistic.
///
/// No model is exact. An error of kModelError standard deviations of the noise in each residual, in whatever
/// direction, counts as no change: an effect must explain more than that error could. Otherwise the evidence of an
/// error far below the noise would grow with every window. A cause that would have to be stronger than it can be
/// counts as no evidence either.
class ChangeDetector {
 public:
  /// Root mean square of the model's error, in standard deviations of the whitened noise. Set: a simulated vehicle
  /// without effects needs 0.047 on steady circles, and one within tolerance more than 0.06 on long spirals.
  static constexpr double kModelError = 0.08;

  /// `root`: of the covariance of all unknowns without a change (root z, z ~ N(0, 1)), square. `noise_factor`:
  /// variance of whitened residuals without a gap.
  ChangeDetector(std::vector<WatchedCause> candidates, Eigen::MatrixXd root, double noise_factor,
                 double model_error = kModelError);

  /// Takes the evidence of the next window (WindowEvidence).
  void take(const Eigen::MatrixXd& gram, const Eigen::VectorXd& score, double measurements);

  /// Logarithm of the statistic, nats; minus infinity before the first window.
  [[nodiscard]] double log_statistic() const { return log_statistic_; }
  [[nodiscard]] std::uint64_t windows() const { return windows_; }

  struct Cause {
    std::size_t candidate = 0;
    double probability = 0;   ///< among the candidates, if one of them is the cause
    std::uint64_t onset = 0;  ///< the most probable first window
  };
  /// All candidates, the most probable first.
  [[nodiscard]] std::vector<Cause> causes() const;
  /// Posterior mean of all unknowns if nothing changed: the vehicle's tolerances as far as they are known.
  [[nodiscard]] const Eigen::VectorXd& mean() const { return mean_; }
  /// Posterior mean of all unknowns if this cause acts since its most probable onset. The part of it that a
  /// tolerance may explain is in it.
  [[nodiscard]] Eigen::VectorXd mean_with(const Cause& cause) const;
  /// Posterior mean of all unknowns if every candidate may act, at its typical strength, since the leading
  /// cause's onset.
  [[nodiscard]] Eigen::VectorXd mean_with_all() const;
  /// Estimated strength of a cause, in typical values.
  [[nodiscard]] double strength(const Cause& cause) const;
  [[nodiscard]] const std::string& name(const Cause& cause) const { return candidates_[cause.candidate].name; }

  /// What the detector knows, to be kept over a restart. Matrices are n x n and symmetric.
  struct State {
    std::uint64_t windows = 0;
    double measurements = 0;
    Eigen::MatrixXd gram;
    Eigen::VectorXd score;
    struct Onset {
      std::uint64_t window = 0;  ///< number of windows before it
      Eigen::MatrixXd gram;      ///< of the windows before it
      Eigen::VectorXd score;
      double measurements = 0;
    };
    std::vector<Onset> onsets;
  };
  [[nodiscard]] State state() const { return {windows_, measurements_, gram_, score_, onsets_}; }
  /// Throws std::invalid_argument for a state of another size.
  void restore(State state);

 private:
  struct Scored {
    std::size_t candidate = 0;
    std::uint64_t onset = 0;
    double log_factor = 0;
    Eigen::VectorXd change;  ///< posterior mean of the cause's unknowns since the onset
  };
  void thin_out();
  void score_onsets();

  std::vector<WatchedCause> candidates_;
  Eigen::MatrixXd root_;
  double noise_factor_, model_error_;
  std::uint64_t windows_ = 0;
  double measurements_ = 0;
  Eigen::MatrixXd gram_;   ///< of all windows
  Eigen::VectorXd score_;  ///< of all windows
  std::vector<State::Onset> onsets_;
  double log_statistic_;
  Eigen::VectorXd mean_;        ///< of all unknowns, nothing changed
  std::vector<Scored> scored_;  ///< of each onset and candidate
};

/// Sequential test whether the power of a channel rose, whatever the cause. The alternative is gamma-distributed
/// power with kRise times the mean of the nulls. The statistic is the mean of the channels' Shiryaev-Roberts
/// statistics.
class PowerDetector {
 public:
  /// Factor on the power that the test is made for. Power below 1.3 times that of the nulls is evidence against a
  /// rise: an instrument that is a little noisier than nominal is no gap.
  static constexpr double kRise = 1.69;

  PowerDetector() = default;
  /// Mean and standard deviation of each channel's power over windows of null missions.
  PowerDetector(Eigen::VectorXd mean, const Eigen::VectorXd& scatter);

  /// Takes the powers of the next window; NaN: not measured.
  void take(const Eigen::VectorXd& power);
  [[nodiscard]] double log_statistic() const;
  /// Channel with the greatest statistic.
  [[nodiscard]] Eigen::Index loudest() const;
  void restart() { log_channels_.setConstant(kNothing); }

  [[nodiscard]] const Eigen::VectorXd& log_channels() const { return log_channels_; }
  /// Throws std::invalid_argument for another number of channels.
  void restore(const Eigen::VectorXd& log_channels);

 private:
  static constexpr double kNothing = -1e9;  ///< logarithm of zero, finite so that files can hold it

  Eigen::VectorXd mean_, shape_;
  Eigen::VectorXd log_channels_;
};

/// Powers of the channels in windows without a gap: that of the hardest manoeuvres stands for each, because
/// tolerances act more there. Only the first `tested` channels that enough windows have are tested.
struct NominalPower {
  PowerDetector detector;
  double mean = 1;  ///< of those channels
};
/// `fewest`: windows that a channel needs. `least_scatter`: relative standard deviation that a power has at least.
[[nodiscard]] NominalPower nominal_power(std::span<const Eigen::VectorXd> windows, Eigen::Index tested,
                                         std::size_t fewest, double least_scatter = 0);

}  // namespace navcal::gap

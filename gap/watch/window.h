// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "gap/inference/effect_subset.h"
#include "gap/inference/library.h"
#include "gap/inference/linearised.h"
#include "gap/inference/spike_and_slab.h"
#include "gap/inference/whitening.h"
#include "gap/replay/replay.h"
#include "gap/watch/window_source.h"

namespace navcal::gap {

/// In which the estimator settles, s.
inline constexpr double kSettling_s = 20;
/// Channels of which a window has a power: those of the evidence, then those of the fixes.
inline constexpr Eigen::Index kPowerChannels = kEvidenceChannels + kFixChannels;

/// What windows are computed with. References; valid as long as what they refer to.
struct WindowProblem {
  const config::VehicleSettings& vehicle;
  const Library& library;
  const Whitening& whitening;
  const Priors& priors;
  /// Unknowns whose part of the design is computed. Biases and current must be among them.
  std::vector<Eigen::Index> columns;
};

/// The gyros' biases and the current of the water: what is new in each window.
[[nodiscard]] std::vector<Eigen::Index> window_nuisances(const Library& library);

/// Evidence by the library's unknowns.
struct ReplayedEvidence : WindowEvidence {
  Eigen::MatrixXd explained_rms;  ///< channels x regimes (explained_rms()), biases fitted
  GyroBias bias_rad_s{};          ///< estimate, for the next window
};

/// Effects that a watch takes for a cause: those of the library but the current of the water, and those that act
/// over more than one window.
[[nodiscard]] EffectSubset watched_effects(const Library& library);

/// The last kWindow_s of a mission of kSettling_s + kWindow_s, replayed.
class Window {
 public:
  /// `bias_rad_s`: point of linearisation. The mission's shortcoming() is empty. `problem` must outlive it.
  Window(const WindowProblem& problem, Mission mission, const GyroBias& bias_rad_s);
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Whether instruments and motor card have enough of the window in common; if not, nothing else may be called.
  [[nodiscard]] bool can_be_judged() const;
  /// Computes the evidence. To be called once, before power_with().
  [[nodiscard]] ReplayedEvidence evidence();
  /// Power of the channels when the vehicle is replayed with these values of all unknowns. Biases are this
  /// window's own, and the current is fitted.
  [[nodiscard]] Eigen::VectorXd power_with(Eigen::VectorXd values) const;

 private:
  [[nodiscard]] ResidualModel model() const;
  void forget_settling(Eigen::MatrixXd& rows) const;
  [[nodiscard]] Eigen::VectorXd power_of(const Eigen::VectorXd& left) const;

  const WindowProblem& problem_;
  Mission mission_;
  std::unique_ptr<Replay> replay_;
  Eigen::VectorXd at_;
  Eigen::MatrixXd basis_;  ///< design of the nuisances, a column each, times the standard deviation of its prior
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd measured_;  ///< whitened residuals at `at_`; zero: not measured
};

}  // namespace navcal::gap

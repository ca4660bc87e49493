// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/replay/calibration.h"
#include "identify/replay/replayed_motion.h"

namespace navcal::identify {

/// Contribution of one window to the normal equations J^T J dx = J^T r. Unknowns in this order: parameters of the
/// layout, nuisances of the window's recording, the state at the window's begin, and that at the begin of the next
/// window.
struct WindowEquations {
  Eigen::MatrixXd gram;
  Eigen::VectorXd score;
};

/// Normal equations of several recordings, each a chain of windows. States are eliminated window by window (a
/// block tridiagonal Cholesky factorisation), which leaves the border: parameters, then the nuisances of each
/// recording.
class ChainSystem {
 public:
  ChainSystem(Eigen::Index parameters, const std::vector<std::size_t>& windows_of_recordings);

  [[nodiscard]] Eigen::Index border() const { return border_gram_.rows(); }
  /// First nuisance of a recording in the border.
  [[nodiscard]] Eigen::Index nuisances_at(std::size_t recording) const {
    return parameters_ + static_cast<Eigen::Index>(recording) * kNuisances;
  }

  void add(std::size_t recording, std::size_t window, const WindowEquations& equations);
  void add_border_prior(Eigen::Index at, double variance, double deviation);
  void add_state_prior(std::size_t recording, std::size_t window, const StateVector& variance,
                       const StateVector& deviation);

  struct Solution {
    Eigen::VectorXd border;
    std::vector<std::vector<StateVector>> states;
  };
  /// `damping` multiplies the diagonal by 1 + damping (Levenberg and Marquardt).
  [[nodiscard]] Solution solve(double damping) const;

  /// The border's matrix without the states: the inverse of the covariance of parameters and nuisances.
  [[nodiscard]] Eigen::MatrixXd information() const;
  /// The scores of single windows of one recording without the states, one column each.
  [[nodiscard]] Eigen::MatrixXd effective_scores(std::size_t recording,
                                                 const std::vector<WindowEquations>& windows) const;

 private:
  struct Chain {
    // For each window: its own block, that with the next window, that with the local border; the right-hand side.
    std::vector<Eigen::Matrix<double, kStates, kStates>> own, next;
    std::vector<Eigen::MatrixXd> border;
    std::vector<StateVector> score;
  };
  struct Eliminated;
  [[nodiscard]] Eliminated eliminate(double damping) const;
  [[nodiscard]] Eigen::VectorXi border_places(std::size_t recording) const;

  Eigen::Index parameters_;
  std::vector<Chain> chains_;
  Eigen::MatrixXd border_gram_;
  Eigen::VectorXd border_score_;
};

}  // namespace navcal::identify

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "gap/inference/library.h"
#include "gap/inference/whitening.h"
#include "gap/replay/replay.h"

namespace navcal::gap {

/// A mission's whitened innovations as a linear function of the library's unknowns about a point:
///   r(values) = residual - design (values - at).
/// The design consists of finite differences of the whole replay, so that it accounts for the
/// part of an effect that the estimator absorbs.
struct Linearised {
  Eigen::VectorXd at;        ///< values of all unknowns
  Eigen::VectorXd residual;  ///< whitened, at that point
  Eigen::MatrixXd design;    ///< a column for each unknown
  Eigen::MatrixXd gram;      ///< design^T design
  Eigen::VectorXd score;     ///< design^T residual
};

/// Another recording of the same vehicle in a joint model. It has the effects in common with the first one, and
/// turn-on biases of its own.
struct JoinedRecording {
  const Replay& replay;
  const Whitening& whitening;
  Eigen::Vector4d biases_rad_s;  ///< of its gyros
  /// Orthonormal columns: what its whitened innovations can show of the biases. That part is left out of the
  /// residuals, so that the biases need no unknowns (Frisch and Waugh 1933).
  Eigen::MatrixXd bias_basis;
};

/// Whitened innovations of one recording, or of several one after the other, as a function of the values of all
/// unknowns. The biases among the unknowns are those of the first recording. References; valid as long as what
/// they refer to.
struct ResidualModel {
  const Replay& replay;
  const Library& library;
  const Whitening& whitening;
  unsigned threads = 1;                       ///< for columns of the design
  std::span<const JoinedRecording> others{};  ///< recordings after the first one
};

[[nodiscard]] Layout layout_of(const Replay& replay);

/// Whitened innovations of a replay with these values of all unknowns.
[[nodiscard]] Eigen::VectorXd residual_at(const ResidualModel& model, const Eigen::VectorXd& values);
/// -d residual / d unknown, one column for each of `columns`; `residual` is the residual at `at`.
[[nodiscard]] Eigen::MatrixXd design_at(const ResidualModel& model, const Eigen::VectorXd& at,
                                        const Eigen::VectorXd& residual, std::span<const Eigen::Index> columns);

/// Linearises about a point; computes all columns.
[[nodiscard]] Linearised linearise(const ResidualModel& model, const Eigen::VectorXd& at);
/// Linearises about another point; computes `columns`, and keeps the others of `from`.
[[nodiscard]] Linearised relinearise(const ResidualModel& model, Linearised from, const Eigen::VectorXd& at,
                                     std::span<const Eigen::Index> columns);
/// Residual of the linear model at zero.
[[nodiscard]] Eigen::VectorXd residual_at_zero(const Linearised& linear);

}  // namespace navcal::gap

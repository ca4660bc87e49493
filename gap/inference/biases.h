// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>

#include "gap/inference/linearised.h"

namespace navcal::gap {

/// Factor of the normal equations of the gyros' biases, from the `gram` of all unknowns. A bias that the
/// mission does not show is solved as zero.
[[nodiscard]] Eigen::LLT<Eigen::Matrix4d> bias_factor(const Eigen::MatrixXd& gram);

/// These values of all unknowns with the gyros' biases fitted by one step of least squares. One step is enough
/// because the replay is nearly linear in them.
[[nodiscard]] Eigen::VectorXd with_biases_fitted(const ResidualModel& model, Eigen::VectorXd values);

/// Start values of a diagnosis for all unknowns: the gyros' biases by least squares, no effects.
[[nodiscard]] Eigen::VectorXd with_biases_found(const Replay& replay, const Library& library, unsigned threads);

/// A recording to be joined to others: its biases, from `at`, and what its residuals can show of them.
[[nodiscard]] JoinedRecording joined(const ResidualModel& model, const Eigen::VectorXd& at);

}  // namespace navcal::gap

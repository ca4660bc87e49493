// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>

#include "gap/inference/linearised.h"

namespace navcal::gap {

/// Solves for the gyros' biases by least squares, `gram` being that of all unknowns; where a mission shows nothing
/// of one, that one is zero.
[[nodiscard]] Eigen::LLT<Eigen::Matrix4d> bias_factor(const Eigen::MatrixXd& gram);

/// These values of all unknowns with the gyros' biases that fit them, by one step of least squares: the replay is
/// nearly linear in them.
[[nodiscard]] Eigen::VectorXd with_biases_fitted(const ResidualModel& model, Eigen::VectorXd values);

/// The values of all unknowns at which a diagnosis begins: the gyros' biases by least squares, no effects.
[[nodiscard]] Eigen::VectorXd with_biases_found(const Replay& replay, const Library& library, unsigned threads);

}  // namespace navcal::gap

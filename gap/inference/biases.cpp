// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/biases.h"

#include <Eigen/QR>
#include <array>
#include <utility>

namespace navcal::gap {

Eigen::LLT<Eigen::Matrix4d> bias_factor(const Eigen::MatrixXd& gram) {
  Eigen::Matrix4d biases = gram.topLeftCorner<Library::kBiases, Library::kBiases>();
  biases.diagonal().array() += 1e-9 * biases.trace() + 1e-12;
  return biases.llt();
}

Eigen::VectorXd with_biases_fitted(const ResidualModel& model, Eigen::VectorXd values) {
  constexpr std::array<Eigen::Index, Library::kBiases> kColumns{0, 1, 2, 3};
  const Eigen::VectorXd residual = residual_at(model, values);
  const Eigen::MatrixXd design = design_at(model, values, residual, kColumns);
  values.head<Library::kBiases>() += bias_factor(design.transpose() * design).solve(design.transpose() * residual);
  return values;
}

Eigen::VectorXd with_biases_found(const Replay& replay, const Library& library, unsigned threads) {
  constexpr int kIterations = 2;
  const Whitening whitening = Whitening::nominal(replay.mission().instruments);
  const ResidualModel model{replay, library, whitening, threads};
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  for (int i = 0; i < kIterations; ++i) {
    values = with_biases_fitted(model, std::move(values));
  }
  return values;
}

JoinedRecording joined(const ResidualModel& model, const Eigen::VectorXd& at) {
  constexpr std::array<Eigen::Index, Library::kBiases> kColumns{0, 1, 2, 3};
  const Eigen::MatrixXd design = design_at(model, at, residual_at(model, at), kColumns);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor(design);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(design.rows(), factor.rank());
  basis.applyOnTheLeft(factor.householderQ());
  return {model.replay, model.whitening, at.head<Library::kBiases>(), std::move(basis)};
}

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#include "runs/scatter.h"

namespace navcal::runs {
namespace {

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& values, const std::vector<std::size_t>& places) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(places.size()), values.cols());
  for (std::size_t i = 0; i < places.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = values.row(static_cast<Eigen::Index>(places[i]));
  }
  return rows;
}

}  // namespace

Scatter scatter_of(const Eigen::MatrixXd& values, std::span<const std::vector<std::size_t>> sessions,
                   double session_over_run) {
  const Eigen::Index n = values.cols();
  Scatter scatter;
  scatter.run.setZero(n, n);
  std::vector<Eigen::VectorXd> means;
  double degrees = 0, inverse_counts = 0;
  for (const auto& session : sessions) {
    if (session.size() < 2) continue;
    const Eigen::MatrixXd rows = rows_of(values, session);
    const Eigen::RowVectorXd mean = rows.colwise().mean();
    const Eigen::MatrixXd centred = rows.rowwise() - mean;
    scatter.run += centred.transpose() * centred;
    degrees += static_cast<double>(session.size() - 1);
    if (session.size() < kRunsOfASession) continue;
    means.emplace_back(mean.transpose());
    inverse_counts += 1 / static_cast<double>(session.size());
  }
  scatter.run /= degrees;
  scatter.sessions = means.size();
  const auto count = static_cast<double>(means.size());
  scatter.mean.setZero(n);
  for (const auto& mean : means) scatter.mean += mean / count;
  if (means.size() < 2) {
    scatter.session = session_over_run * scatter.run.diagonal().asDiagonal();
    return scatter;
  }
  scatter.session.setZero(n, n);
  for (const auto& mean : means) {
    scatter.session += (mean - scatter.mean) * (mean - scatter.mean).transpose() / (count - 1);
  }
  // The scatter of the means contains that of the runs; what is left keeps the correlations of the means.
  const Eigen::VectorXd whole = scatter.session.diagonal();
  const Eigen::VectorXd left =
      (whole - scatter.run.diagonal() * inverse_counts / count).cwiseMax(0) * (1 + 1 / count);
  const Eigen::VectorXd factor = (left.array() / whole.array().max(1e-300)).sqrt().matrix();
  scatter.session = factor.asDiagonal() * scatter.session * factor.asDiagonal();
  return scatter;
}

Eigen::MatrixXd with_weaker_correlations(const Eigen::MatrixXd& covariance, double weight) {
  Eigen::MatrixXd weaker = (1 - weight) * covariance;
  weaker.diagonal() = covariance.diagonal();
  return weaker;
}

}  // namespace navcal::runs

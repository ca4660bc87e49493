// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/prediction_error_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace navcal::gap {
namespace {

/// Distance at which each window begins and ends, intervals.
struct Window {
  Eigen::Index first, last;
};
constexpr std::array<Window, PredictionErrorFilter::kWindows> kPast{
    {{1, 1}, {2, 2}, {3, 4}, {5, 8}, {9, 16}, {17, 32}, {33, 64}}};
/// Ridge, as a share of the regressors' squares: a channel that was never measured gets no weight.
constexpr double kRidge = 1e-6;
constexpr Eigen::Index kRowsForAWeight = 10;

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Goes through rows in order. `visit` gets the number of each row, the means over the windows before it, and
/// their prediction by `weights`. Missing values are replaced by their prediction; before the first row all
/// values are zero.
template <typename Visit>
void walk(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& weights, const Visit& visit) {
  const Eigen::Index channels = rows.cols();
  Rows sums = Rows::Zero(rows.rows() + 1, channels);  // of all rows before
  Eigen::RowVectorXd means(PredictionErrorFilter::kWindows * channels),
      predicted = Eigen::RowVectorXd::Zero(channels);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    for (std::size_t w = 0; w < kPast.size(); ++w) {
      const auto [first, last] = kPast[w];
      const auto from = std::max<Eigen::Index>(0, i - last), until = std::max<Eigen::Index>(0, i - first + 1);
      means.segment(static_cast<Eigen::Index>(w) * channels, channels) =
          (sums.row(until) - sums.row(from)) / static_cast<double>(last - first + 1);
    }
    if (weights.size() > 0) predicted.noalias() = means * weights;
    visit(i, means, predicted);
    for (Eigen::Index j = 0; j < channels; ++j) {
      sums(i + 1, j) = sums(i, j) + (std::isfinite(rows(i, j)) ? rows(i, j) : predicted[j]);
    }
  }
}

/// Normal equations of least squares, one for each channel: not all channels are measured in the same rows.
class LeastSquares {
 public:
  explicit LeastSquares(Eigen::Index channels)
      : products_(static_cast<std::size_t>(channels), zeros(PredictionErrorFilter::kWindows * channels)),
        with_measured_(Eigen::MatrixXd::Zero(PredictionErrorFilter::kWindows * channels, channels)),
        rows_(static_cast<std::size_t>(channels), 0) {}

  void gather(const Eigen::MatrixXd& mission, const Eigen::MatrixXd& weights, Eigen::Index from) {
    Rows means(mission.rows(), with_measured_.rows());
    walk(mission, weights, [&](Eigen::Index i, const auto& past, const auto&) { means.row(i) = past; });
    Eigen::MatrixXd product;
    Eigen::ArrayXd measured, before;
    for (Eigen::Index j = 0; j < mission.cols(); ++j) {
      measured = mission.col(j).array().isFinite().cast<double>();
      measured.head(std::min(from, measured.size())).setZero();
      const Eigen::VectorXd values = (measured > 0).select(mission.col(j).array(), 0.0).matrix();
      // The channels of one instrument are measured together.
      if (j == 0 || (measured != before).any()) {
        product.noalias() = (means.array().colwise() * measured).matrix().transpose() * means;
        before = measured;
      }
      products_[static_cast<std::size_t>(j)] += product;
      with_measured_.col(j).noalias() += means.transpose() * values;
      rows_[static_cast<std::size_t>(j)] += static_cast<Eigen::Index>(measured.sum());
    }
  }

  [[nodiscard]] Eigen::MatrixXd weights() const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(with_measured_.rows(), with_measured_.cols());
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      const auto& product = products_[static_cast<std::size_t>(j)];
      if (rows_[static_cast<std::size_t>(j)] < kRowsForAWeight * result.rows()) continue;
      // Channels are of different units.
      const Eigen::VectorXd size =
          (product.diagonal().array() > 0).select(product.diagonal().array().sqrt(), 1.0).matrix();
      Eigen::MatrixXd scaled = size.cwiseInverse().asDiagonal() * product * size.cwiseInverse().asDiagonal();
      scaled.diagonal().array() += kRidge;
      result.col(j) = scaled.ldlt().solve(with_measured_.col(j).cwiseQuotient(size)).cwiseQuotient(size);
    }
    return result;
  }

 private:
  static Eigen::MatrixXd zeros(Eigen::Index size) { return Eigen::MatrixXd::Zero(size, size); }

  std::vector<Eigen::MatrixXd> products_;
  Eigen::MatrixXd with_measured_;
  std::vector<Eigen::Index> rows_;
};

}  // namespace

PredictionErrorFilter PredictionErrorFilter::learnt(std::span<const Eigen::MatrixXd> noise, Eigen::Index from) {
  if (noise.empty()) return {};
  const bool whole = std::all_of(noise.begin(), noise.end(), [](const auto& rows) { return rows.allFinite(); });
  PredictionErrorFilter filter;
  // The second pass replaces missing values by better predictions.
  for (int pass = 0; pass < (whole ? 1 : 2); ++pass) {
    LeastSquares sums(noise.front().cols());
    for (const Eigen::MatrixXd& rows : noise) sums.gather(rows, filter.weights_, from);
    filter.weights_ = sums.weights();
  }
  return filter;
}

Eigen::MatrixXd PredictionErrorFilter::errors(const Eigen::MatrixXd& rows) const {
  Eigen::MatrixXd errors(rows.rows(), rows.cols());
  walk(rows, weights_, [&](Eigen::Index i, const auto&, const auto& predicted) {
    for (Eigen::Index j = 0; j < rows.cols(); ++j) {
      errors(i, j) = std::isfinite(rows(i, j)) ? rows(i, j) - predicted[j] : 0;
    }
  });
  return errors;
}

}  // namespace navcal::gap

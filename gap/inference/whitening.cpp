// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/whitening.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace navcal::gap {
namespace {

/// Distance at which each window begins and ends, intervals.
struct LagWindow {
  Eigen::Index first, last;
};
constexpr std::array<LagWindow, PredictionErrorFilter::kWindows> kPast{
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

constexpr double kFilterSettling_s = 20;

/// Prediction errors of rows by `filter`. A row that begins a run has no past. A missing value is replaced by
/// its prediction.
Eigen::MatrixXd filtered(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& filter,
                         const std::vector<bool>& begins) {
  const Eigen::Index order = filter.rows();
  Eigen::MatrixXd filled = Eigen::MatrixXd::Zero(rows.rows(), rows.cols());
  Eigen::MatrixXd errors = filled;
  Eigen::Index run = 0;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    run = begins[static_cast<std::size_t>(i)] ? 0 : run + 1;
    const Eigen::Index known = std::min(order, run);
    for (Eigen::Index j = 0; j < rows.cols(); ++j) {
      double predicted = 0;
      for (Eigen::Index k = 0; k < known; ++k) predicted += filter(k, j) * filled(i - 1 - k, j);
      const double value = rows(i, j);
      const bool measured = std::isfinite(value);
      filled(i, j) = measured ? value : predicted;
      errors(i, j) = measured ? value - predicted : 0;
    }
  }
  return errors;
}

/// Coefficients of x_i = sum a_k x_(i-k) by the Yule-Walker equations from the autocovariances of all runs.
Eigen::VectorXd autoregression(const Eigen::VectorXd& covariances) {
  const Eigen::Index order = covariances.size() - 1;
  Eigen::MatrixXd toeplitz(order, order);
  for (Eigen::Index i = 0; i < order; ++i) {
    for (Eigen::Index j = 0; j < order; ++j) toeplitz(i, j) = covariances[std::abs(i - j)];
  }
  toeplitz.diagonal().array() += 1e-9 * covariances[0];
  return toeplitz.ldlt().solve(covariances.tail(order));
}

std::vector<bool> fix_begins(const Layout& layout) {
  std::vector<bool> begins;
  for (const int number : layout.fix_numbers) begins.push_back(number == 0);
  return begins;
}

Eigen::Index settled_row() { return static_cast<Eigen::Index>(kFilterSettling_s / kInterval_s); }

/// Sums of x_i x_(i-k) over all measured pairs, for each channel.
void gather(const Eigen::MatrixXd& rows, const std::vector<bool>& begins, Eigen::Index from, Eigen::MatrixXd& sums,
            Eigen::MatrixXd& counts) {
  for (Eigen::Index j = 0; j < rows.cols(); ++j) {
    for (Eigen::Index i = from; i < rows.rows(); ++i) {
      for (Eigen::Index k = 0; k < sums.rows() && i - k >= from; ++k) {
        if (std::isfinite(rows(i, j)) && std::isfinite(rows(i - k, j))) {
          sums(k, j) += rows(i, j) * rows(i - k, j);
          counts(k, j) += 1;
        }
        if (begins[static_cast<std::size_t>(i - k)]) break;
      }
    }
  }
}

Eigen::MatrixXd filters(const Eigen::MatrixXd& sums, const Eigen::MatrixXd& counts) {
  Eigen::MatrixXd result(sums.rows() - 1, sums.cols());
  for (Eigen::Index j = 0; j < sums.cols(); ++j) {
    const bool enough = (counts.col(j).array() > 10.0 * static_cast<double>(sums.rows())).all();
    if (enough && sums(0, j) > 0) {
      result.col(j) = autoregression(sums.col(j).cwiseQuotient(counts.col(j)));
    } else {
      result.col(j).setZero();
    }
  }
  return result;
}

/// Lower Cholesky factor of the covariance of errors; zeros are missing values.
Eigen::MatrixXd factor(const Eigen::MatrixXd& sums, const Eigen::MatrixXd& counts) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(sums.rows(), sums.cols());
  for (Eigen::Index i = 0; i < sums.rows(); ++i) {
    for (Eigen::Index j = 0; j < sums.cols(); ++j) {
      if (counts(i, j) > 10) covariance(i, j) = sums(i, j) / counts(i, j);
    }
  }
  return covariance.llt().matrixL();
}

void gather_products(const Eigen::MatrixXd& errors, Eigen::Index from, Eigen::MatrixXd& sums,
                     Eigen::MatrixXd& counts) {
  for (Eigen::Index row = from; row < errors.rows(); ++row) {
    const Eigen::VectorXd error = errors.row(row);
    const Eigen::VectorXd present = (error.array() != 0).cast<double>();
    sums += error * error.transpose();
    counts += present * present.transpose();
  }
}

}  // namespace

PredictionErrorFilter PredictionErrorFilter::learnt(std::span<const Eigen::MatrixXd> noise, Eigen::Index from) {
  if (noise.empty()) return {};
  const bool whole = std::ranges::all_of(noise, [](const auto& rows) { return rows.allFinite(); });
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

Whitening::Whitening(std::span<const Innovations> noise, std::span<const Layout> layouts) {
  std::vector<Eigen::MatrixXd> grids;
  Eigen::MatrixXd fix_sums = Eigen::MatrixXd::Zero(kFixOrder + 1, kFixChannels), fix_counts = fix_sums;
  for (std::size_t n = 0; n < noise.size(); ++n) {
    grids.push_back(noise[n].grid.leftCols(kEvidenceChannels));
    gather(noise[n].fixes, fix_begins(layouts[n]), 0, fix_sums, fix_counts);
  }
  grid_filter = PredictionErrorFilter::learnt(grids, settled_row());
  fix_filter = filters(fix_sums, fix_counts);

  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(kEvidenceChannels, kEvidenceChannels), counts = sums;
  fix_sums = fix_counts = Eigen::MatrixXd::Zero(kFixChannels, kFixChannels);
  for (std::size_t n = 0; n < noise.size(); ++n) {
    gather_products(grid_filter.errors(grids[n]), settled_row(), sums, counts);
    gather_products(filtered(noise[n].fixes, fix_filter, fix_begins(layouts[n])), 0, fix_sums, fix_counts);
  }
  grid_factor = factor(sums, counts);
  fix_factor = factor(fix_sums, fix_counts);
}

Whitening Whitening::nominal(const devices::InstrumentModel& instruments) {
  // Each channel is the mean of the readings within an interval.
  const auto of_mean = [](double noise, const devices::Timing& timing) {
    return noise / std::sqrt(std::max(1.0, timing.rate_Hz * kInterval_s));
  };
  const auto& [compass, imu, gps, motor] = instruments;
  const double field = of_mean(compass.field_noise_uT, compass.timing),
               tilt = of_mean(compass.tilt_noise_rad, compass.timing),
               gyro = of_mean(imu.gyro_noise_rad_s, imu.timing), force = of_mean(imu.force_noise_m_s2, imu.timing);
  Whitening result;
  result.fix_filter = Eigen::MatrixXd::Zero(0, kFixChannels);
  Eigen::VectorXd grid(kEvidenceChannels);
  grid << field, field, field, tilt, tilt, gyro, gyro, gyro, force, force, force,
      of_mean(imu.depth_noise_m, imu.timing);
  result.grid_factor = grid.asDiagonal();
  result.fix_factor = Eigen::Vector4d{1, 1, gps.velocity_noise_m_s, gps.velocity_noise_m_s}.asDiagonal();
  return result;
}

Eigen::VectorXd Whitening::operator()(const Innovations& innovations, const Layout& layout) const {
  Eigen::MatrixXd grid = grid_filter.errors(innovations.grid.leftCols(kEvidenceChannels)).transpose();
  Eigen::MatrixXd fixes = filtered(innovations.fixes, fix_filter, fix_begins(layout)).transpose();
  const auto whiten = [](Eigen::MatrixXd& errors, const Eigen::MatrixXd& lower) {
    if (errors.size() == 0) return;  // a mission without fixes
    const Eigen::ArrayXXd present = (errors.array() != 0).cast<double>();
    lower.triangularView<Eigen::Lower>().solveInPlace(errors);
    errors.array() *= present;
  };
  whiten(grid, grid_factor);
  whiten(fixes, fix_factor);
  grid.leftCols(std::min(settled_row(), grid.cols())).setZero();
  Eigen::VectorXd all(grid.size() + fixes.size());
  all << Eigen::Map<const Eigen::VectorXd>(grid.data(), grid.size()),
      Eigen::Map<const Eigen::VectorXd>(fixes.data(), fixes.size());
  return all;
}

Eigen::Index Whitening::count(const Eigen::VectorXd& white) { return (white.array() != 0).count(); }

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/linearised.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace navcal::gap {
namespace {

/// One column of the design, by a finite difference towards the side that the bounds allow.
Eigen::VectorXd column(const ResidualModel& model, const Eigen::VectorXd& at, const Eigen::VectorXd& residual,
                       Eigen::Index j) {
  const Unknown& unknown = model.library.unknowns()[static_cast<std::size_t>(j)];
  const bool there = at[j] > unknown.onward * unknown.typical;
  double step = (there ? unknown.onward : unknown.step) * unknown.typical;
  if (at[j] + step > unknown.greatest) step = -step;
  Eigen::VectorXd values = at;
  values[j] += step;
  return (residual - residual_at(model, values)) / step;
}

/// Recomputes the rows and columns of design^T design for the new columns, a few at a time: the design is
/// larger than any cache.
void renew_gram(Linearised& linear, std::span<const Eigen::Index> columns, unsigned threads) {
  constexpr std::size_t kTogether = 12;
  const std::size_t parts = (columns.size() + kTogether - 1) / kTogether;
  std::vector<Eigen::MatrixXd> products(parts);
  const auto part = [&](std::size_t i) {
    return columns.subspan(i * kTogether, std::min(kTogether, columns.size() - i * kTogether));
  };
  base::in_parallel(threads, parts, [&](std::size_t i) {
    Eigen::MatrixXd some(linear.design.rows(), static_cast<Eigen::Index>(part(i).size()));
    for (Eigen::Index k = 0; k < some.cols(); ++k) {
      some.col(k) = linear.design.col(part(i)[static_cast<std::size_t>(k)]);
    }
    products[i] = linear.design.transpose() * some;
  });
  for (std::size_t i = 0; i < parts; ++i) {
    for (std::size_t k = 0; k < part(i).size(); ++k) {
      const auto product = products[i].col(static_cast<Eigen::Index>(k));
      linear.gram.col(part(i)[k]) = product;
      linear.gram.row(part(i)[k]) = product.transpose();
    }
  }
}

}  // namespace

Layout layout_of(const Replay& replay) {
  Layout layout{replay.intervals(), {}};
  for (const FixReading& fix : replay.mission().fixes) layout.fix_numbers.push_back(fix.number);
  return layout;
}

Eigen::VectorXd residual_at(const ResidualModel& model, const Eigen::VectorXd& values) {
  Eigen::VectorXd first = model.whitening(model.replay.run(model.library.model(values)), layout_of(model.replay));
  if (model.others.empty()) return first;
  std::vector<Eigen::VectorXd> parts{std::move(first)};
  Eigen::Index rows = parts.front().size();
  Eigen::VectorXd own = values;
  for (const JoinedRecording& other : model.others) {
    own.head<Library::kBiases>() = other.biases_rad_s;
    Eigen::VectorXd part = other.whitening(other.replay.run(model.library.model(own)), layout_of(other.replay));
    part -= other.bias_basis * (other.bias_basis.transpose() * part);
    rows += part.size();
    parts.push_back(std::move(part));
  }
  Eigen::VectorXd all(rows);
  Eigen::Index row = 0;
  for (const Eigen::VectorXd& part : parts) {
    all.segment(row, part.size()) = part;
    row += part.size();
  }
  return all;
}

Eigen::MatrixXd design_at(const ResidualModel& model, const Eigen::VectorXd& at, const Eigen::VectorXd& residual,
                          std::span<const Eigen::Index> columns) {
  Eigen::MatrixXd design(residual.size(), static_cast<Eigen::Index>(columns.size()));
  base::in_parallel(model.threads, columns.size(), [&](std::size_t i) {
    design.col(static_cast<Eigen::Index>(i)) = column(model, at, residual, columns[i]);
  });
  return design;
}

Linearised linearise(const ResidualModel& model, const Eigen::VectorXd& at) {
  const auto rows = residual_at(model, at).size();
  Linearised empty;
  empty.design.setZero(rows, at.size());
  empty.gram.setZero(at.size(), at.size());
  return relinearise(model, std::move(empty), at, model.library.moving());
}

Linearised relinearise(const ResidualModel& model, Linearised from, const Eigen::VectorXd& at,
                       std::span<const Eigen::Index> columns) {
  Linearised result = std::move(from);
  result.at = at;
  result.residual = residual_at(model, at);
  base::in_parallel(model.threads, columns.size(), [&](std::size_t i) {
    result.design.col(columns[i]) = column(model, at, result.residual, columns[i]);
  });
  renew_gram(result, columns, model.threads);
  result.score = result.design.transpose() * result.residual;
  return result;
}

Eigen::VectorXd residual_at_zero(const Linearised& linear) {
  Eigen::VectorXd residual = linear.residual;
  for (Eigen::Index j = 0; j < linear.at.size(); ++j) {
    if (linear.at[j] != 0) residual += linear.at[j] * linear.design.col(j);
  }
  return residual;
}

}  // namespace navcal::gap

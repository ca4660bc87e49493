// SPDX-License-Identifier: Apache-2.0
#include "autopilot/controllability.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace navcal::autopilot {
namespace {

constexpr double kNothing = 1e-6;
/// Couplings of less than this part, as by the torque of a propeller, are not mentioned.
constexpr double kHardly = 0.02;

/// Degrees of freedom that are commanded neither alone nor never, by groups that one missing direction couples.
std::vector<std::string> coupled_words(const Eigen::MatrixXd& missing, const std::array<Command, 6>& commands) {
  std::vector<std::string> words;
  const Eigen::MatrixXd projection = missing * missing.transpose();
  std::array<bool, 6> is_said{};
  for (Eigen::Index i = 0; i < 6; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (is_said[at] || commands[at] != Command::with_others) continue;
    std::vector<std::string> group;
    for (Eigen::Index j = i; j < 6; ++j) {
      const auto other = static_cast<std::size_t>(j);
      if (commands[other] != Command::with_others || std::abs(projection(i, j)) < kHardly * kHardly) continue;
      is_said[other] = true;
      group.emplace_back(kDegreesOfFreedom[other]);
    }
    words.push_back(fmt::format("{} only together", fmt::join(group, " and ")));
  }
  return words;
}

}  // namespace

Controllability controllability(const Allocator& allocator, const Wrench& velocity) {
  Controllability result;
  const Eigen::MatrixXd B = allocator.matrix(velocity);
  const Allocator::Limits limits = allocator.limits(velocity);
  const Eigen::VectorXd most = limits.low.cwiseAbs().cwiseMax(limits.high.cwiseAbs());
  // Six columns at least, so that the left singular vectors span all directions.
  Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(6, std::max<Eigen::Index>(6, B.cols()));
  scaled.leftCols(B.cols()) = allocator.row_scales(B, limits).asDiagonal() * B * most.asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeFullU);
  const Eigen::VectorXd& values = svd.singularValues();
  for (Eigen::Index i = 0; i < 6; ++i) {
    result.singular_values[static_cast<std::size_t>(i)] = values[i];
    if (values[i] > kNothing * values[0] && values[0] > 0) ++result.rank;
  }
  if (result.rank > 0) result.condition = values[0] / values[result.rank - 1];
  std::vector<std::string> never;
  const Eigen::MatrixXd missing = svd.matrixU().rightCols(6 - result.rank);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double outside = missing.row(i).norm();
    Command& command = result.commands[static_cast<std::size_t>(i)];
    const double inside = std::sqrt(std::max(0.0, 1 - outside * outside));
    command = outside < kHardly ? Command::alone : inside < kHardly ? Command::no : Command::with_others;
    if (command == Command::no) never.emplace_back(kDegreesOfFreedom[static_cast<std::size_t>(i)]);
  }
  if (!never.empty()) result.missing.push_back(fmt::format("{} cannot be commanded", fmt::join(never, ", ")));
  for (std::string& words : coupled_words(missing, result.commands)) result.missing.push_back(std::move(words));
  return result;
}

}  // namespace navcal::autopilot

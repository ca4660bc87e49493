// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/null_bayes_factors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "gap/inference/subset_evidence.h"
#include "gap/nulls/null_mission.h"
#include "gap/nulls/simulate_feasible.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Distance of the seeds of two missions of one null vehicle: any odd number far from those of other seeds.
constexpr std::uint64_t kNextMission = 0x9e3779b97f4a7c15;

/// Adds to the members those other unknowns whose usual tolerance resembles a member most, so that their
/// regressors are computed for each null, too. A null's fins move otherwise between two reports than the
/// recorded ones. With the recorded regressors only, its fin lag would pass for a member.
std::vector<Eigen::Index> with_likenesses(std::vector<Eigen::Index> members, const Linearised& linear,
                                          const Priors& priors) {
  std::vector<std::pair<double, Eigen::Index>> others;
  for (Eigen::Index k = Library::kBiases; k < linear.gram.rows(); ++k) {
    if (std::ranges::find(members, k) != members.end()) continue;
    double most = 0;
    for (const Eigen::Index j : members) {
      most = std::max(most, priors.spike[k] * std::abs(linear.gram(j, k)) / std::sqrt(linear.gram(j, j)));
    }
    if (most > kLikeness_sigma) others.emplace_back(-most, k);
  }
  std::ranges::sort(others);
  for (std::size_t i = 0; i < std::min(kMostLikenesses, others.size()); ++i) members.push_back(others[i].second);
  return members;
}

/// Whitened regressors of some unknowns of the library, in the shape of the recorded mission: one column each.
Eigen::MatrixXd signatures(const ResidualModel& model, const Layout& layout, const Eigen::VectorXd& white,
                           const std::vector<Eigen::Index>& unknowns) {
  const Library& library = model.library;
  Eigen::MatrixXd columns(white.size(), static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(unknowns[k])];
    const double step = unknown.step * unknown.typical;
    Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
    values[unknowns[k]] = step;
    const Innovations stepped = model.replay.run(library.model(values));
    columns.col(static_cast<Eigen::Index>(k)) =
        (white - model.whitening(fitted_into(stepped, layout), layout)) / step;
  }
  return columns;
}

/// Linear model of a null: the recorded mission's regressors, but the null's own ones for these unknowns.
Linearised seen_by(const Linearised& recorded, Eigen::VectorXd white, const Eigen::MatrixXd& own,
                   const std::vector<Eigen::Index>& unknowns) {
  Linearised null;
  null.at = Eigen::VectorXd::Zero(recorded.at.size());
  null.gram = recorded.gram;
  null.score = recorded.design.transpose() * white;
  const Eigen::MatrixXd with_others = recorded.design.transpose() * own, with_own = own.transpose() * own;
  const Eigen::VectorXd own_score = own.transpose() * white;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    null.gram.col(unknowns[k]) = with_others.col(column);
    null.gram.row(unknowns[k]) = with_others.col(column).transpose();
    null.score[unknowns[k]] = own_score[column];
  }
  null.gram(unknowns, unknowns) = with_own;
  null.residual = std::move(white);
  return null;
}

/// Innovations of one null in the shape of the recorded mission, whitened, and its regressors for some unknowns.
struct NullSeen {
  Eigen::VectorXd white;
  Eigen::MatrixXd own;
};

NullSeen null_seen(const RepeatedMission& repeated, const ResidualModel& recorded, const Model& truth,
                   const std::vector<Eigen::Index>& columns, std::uint64_t seed) {
  const Layout layout = layout_of(repeated.recorded);
  const Mission mission = null_mission(repeated, truth.effects, seed);
  const Replay replay(mission, repeated.vehicle);
  NullSeen seen;
  seen.white = recorded.whitening(fitted_into(replay.run({}), layout), layout);
  seen.own = signatures({replay, recorded.library, recorded.whitening}, layout, seen.white, columns);
  return seen;
}

/// Puts the rows of another mission of the same null vehicle below, without what they show of the gyros' biases.
void append_rows(const NullSeen& other, const Eigen::MatrixXd& bias_basis, NullSeen& all) {
  const Eigen::Index above = all.white.size();
  all.white.conservativeResize(above + other.white.size());
  all.white.tail(other.white.size()) = other.white - bias_basis * (bias_basis.transpose() * other.white);
  all.own.conservativeResize(above + other.white.size(), Eigen::NoChange);
  all.own.bottomRows(other.white.size()) = other.own - bias_basis * (bias_basis.transpose() * other.own);
}

}  // namespace

double gain_over_none(const EffectSubset& set, const LinearGaussianModel& model) {
  const SubsetEvidence evidence(model);
  return evidence(set) - bound_penalty_nats(set, model) - evidence({}) + bound_penalty_nats({}, model);
}

std::vector<double> null_bayes_factors(const EffectSubset& set, std::span<const RepeatedMission> repeated,
                                       const InferenceProblem& problem, const BankOptions& options) {
  const ResidualModel& model = problem.model;
  const auto columns = with_likenesses(parameter_indices(model.library, set), problem.nominal, problem.priors);
  return simulate_feasible(options, Seeds::null_gains, [&](std::size_t, std::uint64_t seed) {
    const Model truth = model.library.model(benign_mismatch(model.library, seed));
    NullSeen seen = null_seen(repeated.front(), model, truth, columns, seed);
    for (std::size_t i = 0; i < model.others.size(); ++i) {
      const JoinedRecording& other = model.others[i];
      // The vehicle is the same in all missions; their noise is not.
      const std::uint64_t noise = seed + (i + 1) * kNextMission;
      append_rows(
          null_seen(repeated[i + 1], {other.replay, model.library, other.whitening}, truth, columns, noise),
          other.bias_basis, seen);
    }
    const Linearised null = seen_by(problem.nominal, std::move(seen.white), seen.own, columns);
    return gain_over_none(set, problem.about(null));
  });
}

bool stands_out(double gain_nats, std::span<const double> among_nulls) {
  if (among_nulls.empty()) return true;
  const auto count = static_cast<double>(among_nulls.size());
  const double mean = std::accumulate(among_nulls.begin(), among_nulls.end(), 0.0) / count;
  double square = 0;
  for (const double gain : among_nulls) square += (gain - mean) * (gain - mean);
  return gain_nats > mean + kNullBayesFactor_sigma * std::max(kLeastNullScatter_nats, std::sqrt(square / count));
}

}  // namespace navcal::gap

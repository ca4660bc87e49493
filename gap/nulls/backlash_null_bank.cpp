// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/backlash_null_bank.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gap/nulls/null_mission.h"
#include "gap/nulls/simulate_feasible.h"

namespace navcal::gap {
namespace {

/// Step of the search for a width, typical values.
constexpr double kWidthStep = 0.05;
constexpr int kMostSteps = 8;

struct BacklashNull {
  Eigen::MatrixXd explained_rms;
  Eigen::VectorXd score, excess;
};

/// The value of unknown j that leaves the smallest residuals, with all others as they are. It is found by
/// search: the derivative by a backlash does not show where the minimum is.
double least_left(const ResidualModel& model, Eigen::VectorXd values, Eigen::Index j) {
  const Unknown& unknown = model.library.unknowns()[static_cast<std::size_t>(j)];
  const double step = kWidthStep * unknown.typical;
  const auto left = [&](double value) {
    values[j] = std::clamp(value, unknown.least, unknown.greatest);
    return residual_at(model, values).squaredNorm();
  };
  double at = values[j], here = left(at), below = left(at - step), above = left(at + step);
  for (int i = 0; i < kMostSteps && (below < here || above < here); ++i) {
    if (below < above) {
      above = here;
      here = below;
      at -= step;
      below = left(at - step);
    } else {
      below = here;
      here = above;
      at += step;
      above = left(at + step);
    }
  }
  const double curvature = below - 2 * here + above;
  if (!(curvature > 0)) return at;
  return std::clamp(at + std::clamp(step * (below - above) / (2 * curvature), -step, step), unknown.least,
                    unknown.greatest);
}

/// Simulates a vehicle within tolerance whose unknowns `widths` have the values found, and replays it with the
/// widths that fit it best.
BacklashNull simulate_backlash_null(const ModelFit& found, const RepeatedMission& repeated,
                                    const ResidualModel& recorded, const std::vector<Eigen::Index>& widths,
                                    std::uint64_t seed) {
  const Library& library = recorded.library;
  Eigen::VectorXd truth = benign_mismatch(library, seed), values = Eigen::VectorXd::Zero(truth.size());
  for (const Eigen::Index j : widths) truth[j] = found.mean[j];
  const Mission mission = null_mission(repeated, library.model(truth).effects, seed);
  const Replay replay(mission, repeated.vehicle);
  const ResidualModel model{replay, library, recorded.whitening};
  for (const Eigen::Index j : widths) values[j] = least_left(model, truth, j);
  BacklashNull null;
  null.excess = Eigen::VectorXd::Zero(truth.size());
  for (const Eigen::Index j : widths) null.excess[j] = values[j] - truth[j];
  Trajectory10Hz course;
  const Innovations rest = replay.run(library.model(values), &course);
  null.explained_rms = explained_rms(rest, course, mission.fix_times_s());
  const Layout layout = layout_of(recorded.replay);
  null.score = found.linear.design.transpose() * recorded.whitening(fitted_into(rest, layout), layout);
  return null;
}

}  // namespace

bool has_backlash(const Library& library, const EffectSubset& effects) {
  return std::ranges::any_of(effects, [&](std::size_t effect) { return library.is_backlash(effect); });
}

BacklashNullBank backlash_null_bank(const ModelFit& found, const RepeatedMission& repeated,
                                    const ResidualModel& model, const BankOptions& options) {
  EffectSubset backlashes;
  std::ranges::copy_if(found.effects, std::back_inserter(backlashes),
                       [&](std::size_t effect) { return model.library.is_backlash(effect); });
  const auto widths = parameter_indices(model.library, backlashes);
  const auto nulls = simulate_feasible(options, Seeds::backlash_null_bank, [&](std::size_t, std::uint64_t seed) {
    return simulate_backlash_null(found, repeated, model, widths, seed);
  });
  BacklashNullBank bank;
  bank.missions = static_cast<int>(nulls.size());
  bank.excess = bank.scatter = Eigen::VectorXd::Zero(found.mean.size());
  bank.scores.resize(found.mean.size(), bank.missions);
  if (nulls.empty()) return bank;
  std::vector<Eigen::MatrixXd> all;
  const auto count = static_cast<double>(nulls.size());
  for (std::size_t i = 0; i < nulls.size(); ++i) {
    all.push_back(nulls[i].explained_rms);
    bank.excess += nulls[i].excess / count;
    bank.scores.col(static_cast<Eigen::Index>(i)) = nulls[i].score;
  }
  for (const BacklashNull& null : nulls) bank.scatter += (null.excess - bank.excess).cwiseAbs2() / count;
  bank.scatter = bank.scatter.cwiseSqrt();
  bank.explained_rms = RegimeStatistics(all);
  return bank;
}

Priors widened(Priors priors, const Library& library, const ModelFit& found, const BacklashNullBank& bank) {
  const Priors shown = fit_spike_widths(library, found.linear.gram, bank.scores);
  priors.spike = priors.spike.cwiseMax(shown.spike);
  priors.model_error = priors.model_error.cwiseMax(shown.model_error);
  return priors;
}

void correct(ModelFit& found, const Library& library, const BacklashNullBank& bank) {
  for (Eigen::Index j = Library::kBiases; j < found.mean.size(); ++j) {
    if (bank.excess[j] == 0) continue;
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
    found.mean[j] = std::clamp(found.mean[j] - bank.excess[j], unknown.least, unknown.greatest);
    found.std[j] = std::hypot(found.std[j], bank.scatter[j]);
  }
}

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/backlash_null_bank.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gap/nulls/null_mission.h"
#include "gap/nulls/simulate_feasible.h"

namespace navcal::gap {
namespace {

/// Of a search for a width, in typical values.
constexpr double kStep = 0.05;
constexpr int kMostSteps = 8;

struct Twin {
  Eigen::MatrixXd explained_rms;
  Eigen::VectorXd score, excess;
};

/// The value of unknown j that leaves least, all others as they are: by trial, since a play's slope says little of
/// where that is.
double least_left(const Replay& replay, const Library& library, const Whitening& whitening, Eigen::VectorXd values,
                  Eigen::Index j) {
  const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
  const double step = kStep * unknown.typical;
  const auto left = [&](double value) {
    values[j] = std::clamp(value, unknown.least, unknown.greatest);
    return residual_at(replay, library, whitening, values).squaredNorm();
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

}  // namespace

bool has_play(const Library& library, const EffectSubset& effects) {
  return std::any_of(effects.begin(), effects.end(),
                     [&](std::size_t effect) { return library.is_backlash(effect); });
}

BacklashNullBank backlash_null_bank(const Replay& recorded, const Trajectory10Hz& course,
                                    const config::VehicleSettings& vehicle, const Library& library,
                                    const Whitening& whitening, const ModelFit& found,
                                    const BankOptions& options) {
  EffectSubset plays;
  std::copy_if(found.effects.begin(), found.effects.end(), std::back_inserter(plays),
               [&](std::size_t effect) { return library.is_backlash(effect); });
  const auto widths = parameter_indices(library, plays);
  const Layout layout = layout_of(recorded);
  const auto twins = simulate_feasible(options, Seeds::backlash_null_bank, [&](std::size_t, std::uint64_t seed) {
    Eigen::VectorXd truth = benign_mismatch(library, seed), model = Eigen::VectorXd::Zero(truth.size());
    for (const Eigen::Index j : widths) truth[j] = found.mean[j];
    const Mission mission = null_mission(recorded, course, vehicle, library.model(truth).effects, seed);
    const Replay replay(mission, vehicle);
    for (const Eigen::Index j : widths) model[j] = least_left(replay, library, whitening, truth, j);
    Twin twin;
    twin.excess = Eigen::VectorXd::Zero(truth.size());
    for (const Eigen::Index j : widths) twin.excess[j] = model[j] - truth[j];
    Trajectory10Hz its_course;
    const Innovations rest = replay.run(library.model(model), &its_course);
    twin.explained_rms = explained_rms(rest, its_course, mission.fix_times_s());
    twin.score = found.linear.design.transpose() * whitening(fitted_into(rest, layout), layout);
    return twin;
  });

  BacklashNullBank result;
  result.missions = static_cast<int>(twins.size());
  result.excess = result.scatter = Eigen::VectorXd::Zero(found.mean.size());
  result.scores.resize(found.mean.size(), result.missions);
  if (twins.empty()) return result;
  std::vector<Eigen::MatrixXd> all;
  const auto count = static_cast<double>(twins.size());
  for (std::size_t i = 0; i < twins.size(); ++i) {
    all.push_back(twins[i].explained_rms);
    result.excess += twins[i].excess / count;
    result.scores.col(static_cast<Eigen::Index>(i)) = twins[i].score;
  }
  for (const Twin& twin : twins) result.scatter += (twin.excess - result.excess).cwiseAbs2() / count;
  result.scatter = result.scatter.cwiseSqrt();
  result.explained_rms = RegimeStatistics(all);
  return result;
}

Priors with_twins(Priors priors, const Library& library, const ModelFit& found, const BacklashNullBank& twins) {
  const Priors shown = fit_spike_widths(library, found.linear.gram, twins.scores);
  priors.spike = priors.spike.cwiseMax(shown.spike);
  priors.model_error = priors.model_error.cwiseMax(shown.model_error);
  return priors;
}

void correct(ModelFit& found, const Library& library, const BacklashNullBank& twins) {
  for (Eigen::Index j = Library::kBiases; j < found.mean.size(); ++j) {
    if (twins.excess[j] == 0) continue;
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
    found.mean[j] = std::clamp(found.mean[j] - twins.excess[j], unknown.least, unknown.greatest);
    found.std[j] = std::hypot(found.std[j], twins.scatter[j]);
  }
}

}  // namespace navcal::gap

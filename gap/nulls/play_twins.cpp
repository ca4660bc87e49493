#include "gap/nulls/play_twins.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gap/nulls/able_vehicles.h"
#include "gap/nulls/null_mission.h"

namespace navcal::gap {
namespace {

/// Of a search for a width, in typical values.
constexpr double kStep = 0.05;
constexpr int kMostSteps = 8;

struct Twin {
  Eigen::MatrixXd followed;
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

bool has_play(const Library& library, const CauseSet& effects) {
  return std::any_of(effects.begin(), effects.end(), [&](std::size_t effect) { return library.is_play(effect); });
}

PlayTwins play_twins(const Replay& recorded, const Course10Hz& course, const config::VehicleSettings& vehicle,
                     const Library& library, const Whitening& whitening, const Explanation& found,
                     const BankOptions& options) {
  CauseSet plays;
  std::copy_if(found.effects.begin(), found.effects.end(), std::back_inserter(plays),
               [&](std::size_t effect) { return library.is_play(effect); });
  const auto widths = members_of(library, plays);
  const Layout layout = layout_of(recorded);
  const auto twins = of_able_vehicles(options, Seeds::play_twins, [&](std::size_t, std::uint64_t seed) {
    Eigen::VectorXd truth = benign_mismatch(library, seed), model = Eigen::VectorXd::Zero(truth.size());
    for (const Eigen::Index j : widths) truth[j] = found.mean[j];
    const Mission mission = null_mission(recorded, course, vehicle, library.model(truth).effects, seed);
    const Replay replay(mission, vehicle);
    for (const Eigen::Index j : widths) model[j] = least_left(replay, library, whitening, truth, j);
    Twin twin;
    twin.excess = Eigen::VectorXd::Zero(truth.size());
    for (const Eigen::Index j : widths) twin.excess[j] = model[j] - truth[j];
    Course10Hz its_course;
    const Innovations rest = replay.run(library.model(model), &its_course);
    twin.followed = followed(rest, its_course, mission.fix_times_s());
    twin.score = found.linear.design.transpose() * whitening(fitted_into(rest, layout), layout);
    return twin;
  });

  PlayTwins result;
  result.missions = static_cast<int>(twins.size());
  result.excess = result.scatter = Eigen::VectorXd::Zero(found.mean.size());
  result.scores.resize(found.mean.size(), result.missions);
  if (twins.empty()) return result;
  std::vector<Eigen::MatrixXd> all;
  const auto count = static_cast<double>(twins.size());
  for (std::size_t i = 0; i < twins.size(); ++i) {
    all.push_back(twins[i].followed);
    result.excess += twins[i].excess / count;
    result.scores.col(static_cast<Eigen::Index>(i)) = twins[i].score;
  }
  for (const Twin& twin : twins) result.scatter += (twin.excess - result.excess).cwiseAbs2() / count;
  result.scatter = result.scatter.cwiseSqrt();
  result.followed = RegimeStatistics(all);
  return result;
}

Priors with_twins(Priors priors, const Library& library, const Explanation& found, const PlayTwins& twins) {
  const Priors shown = learnt_priors(library, found.linear.gram, twins.scores);
  priors.spike = priors.spike.cwiseMax(shown.spike);
  priors.model_error = priors.model_error.cwiseMax(shown.model_error);
  return priors;
}

void correct(Explanation& found, const Library& library, const PlayTwins& twins) {
  for (Eigen::Index j = Library::kBiases; j < found.mean.size(); ++j) {
    if (twins.excess[j] == 0) continue;
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
    found.mean[j] = std::clamp(found.mean[j] - twins.excess[j], unknown.least, unknown.greatest);
    found.std[j] = std::hypot(found.std[j], twins.scatter[j]);
  }
}

}  // namespace navcal::gap

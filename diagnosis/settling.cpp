// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/settling.h"

#include <algorithm>
#include <utility>

#include "diagnosis/limits.h"

namespace navcal::diagnosis {
namespace {

/// Log prior of departures that contain a change, but for a constant and the prior of the change.
double log_prior_of_departures(const Eigen::VectorXd& at, const JointPrior& prior, const Eigen::VectorXd& change) {
  const Eigen::VectorXd apart = at - prior.in_each(change) - prior.mean;
  return -prior.root.triangularView<Eigen::Lower>().solve(apart).squaredNorm() / 2;
}

}  // namespace

std::optional<RecordingFit> settled(const RecordingModel& recording, const JointPrior& prior, Departures from,
                                    const ChangeOf& change_of, const LogPriorOf& log_prior_of) {
  std::optional<RecordingFit> best;
  Eigen::VectorXd &at = from.at, &change = from.change;
  const Eigen::Index own = change.size();
  Departures best_from = from;
  double most = 0;
  // A bound that cuts off a part of a change does so in all recordings.
  const auto confine = [&] {
    const Eigen::VectorXd beyond = recording.within(at) - at;
    Eigen::VectorXd cut_off = Eigen::VectorXd::Zero(own);
    for (Eigen::Index i = 0; i < prior.recordings; ++i) {
      const auto here = beyond.segment(i * own, own).array();
      cut_off = (change.array() != 0 && here.abs() > cut_off.array().abs()).select(here, cut_off);
    }
    change += cut_off;
    at = recording.within(at + prior.in_each(cut_off));
  };
  double damping = 1;
  const auto prior_here = [&] { return log_prior_of_departures(at, prior, change) + log_prior_of(change); };
  // Goes where a likelihood leads, beyond the bounds of tolerances as well.
  const auto step = [&](const Likelihood& guide, const JointPrior& near, const Anchor& anchor) {
    change = change_of(near.of_changes(guide), anchor);
    const Eigen::VectorXd everywhere = prior.in_each(change);
    at = near.posterior_mean(guide.about(everywhere)) + everywhere;
  };
  const auto finished = [&] {
    if (!best) return std::move(best);
    best->change = best_from.change;
    step(best->linear, prior, {});
    best->promised_nats = std::max(0.0, best->linear.about(at).value + prior_here() - most);
    return std::move(best);
  };
  confine();
  for (int round = 0; round < kMostSettlings; ++round) {
    auto fit = recording.fit(at);
    if (!fit) break;
    const double value = fit->linear.about(at).value + prior_here();
    const bool is_there = best && value < most + kSettledWithin_nats;
    best = std::move(fit);
    most = value;
    best_from = from;
    if (is_there) break;
    // A step that leads too far is damped before it is linearised, which takes longer.
    damping = std::max(1.0, damping / kDampingStep);
    for (bool is_better = false; !is_better; damping *= kDampingStep) {
      if (damping > kMostDamping) return finished();
      const double factor = best->damping() * damping;
      const Likelihood guide = best->linear.tempered(factor);
      // All priors move along, so that the step is shorter the more it is damped.
      const Anchor anchor{best_from.change, 1 - 1 / factor};
      JointPrior near = prior;
      near.mean += anchor.share * (best_from.at - prior.in_each(best_from.change) - prior.mean);
      step(guide, near, anchor);
      confine();
      const auto likelihood = recording.log_likelihood(at);
      is_better = likelihood && *likelihood + prior_here() >= most;
    }
  }
  return finished();
}

}  // namespace navcal::diagnosis

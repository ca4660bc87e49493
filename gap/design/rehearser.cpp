// SPDX-License-Identifier: Apache-2.0
#include "gap/design/rehearser.h"

#include <algorithm>

#include "base/parallel.h"
#include "gap/inference/linearised.h"
#include "gap/replay/replay.h"

namespace navcal::gap {
namespace {

/// Adds X_i^T X_i of the rows of each part.
void add_rows(const Eigen::MatrixXd& design, Eigen::Index from, Eigen::Index count, Eigen::MatrixXd& gram) {
  if (count > 0) gram.noalias() += design.middleRows(from, count).transpose() * design.middleRows(from, count);
}

}  // namespace

std::ptrdiff_t part_at(std::span<const double> began_s, double time_s) {
  return std::ranges::upper_bound(began_s, time_s) - began_s.begin() - 1;
}

PlannedPath ReferenceRehearser::path(const config::Mission& mission, double longest_s,
                                     const Hypothesis* changed) const {
  if (changed == nullptr) return planned_path(problem_.vehicle, mission, sim::EffectSet(), longest_s);
  Eigen::VectorXd members = Eigen::VectorXd::Zero(changed->mean.size());
  for (const Eigen::Index j : parameter_indices(problem_.library, changed->effects)) members[j] = changed->mean[j];
  return planned_path(problem_.vehicle, mission, problem_.library.model(members).effects, longest_s);
}

Rehearsal ReferenceRehearser::rehearse(const config::Mission& mission, double duration_s,
                                       std::span<const double> part_began_s) const {
  const Mission readings = planned_readings(problem_.vehicle, mission, problem_.instruments, duration_s);
  const Replay replay(readings, problem_.vehicle);
  Trajectory10Hz course;
  (void)replay.run(Model{}, &course);
  const Eigen::VectorXd& at = problem_.at;
  const Linearised linear = linearise({replay, problem_.library, problem_.whitening, problem_.threads}, at);
  Rehearsal rehearsal;
  rehearsal.gram = linear.gram;
  rehearsal.parts.assign(part_began_s.size(), Eigen::MatrixXd::Zero(at.size(), at.size()));
  if (part_began_s.empty() || course.time_s.empty()) return rehearsal;
  base::in_parallel(problem_.threads, part_began_s.size(), [&](std::size_t part) {
    const auto row_of = [&](double time_s) {
      const auto interval = std::ranges::lower_bound(course.time_s, time_s);
      return std::min<Eigen::Index>(interval - course.time_s.begin(), replay.intervals());
    };
    const Eigen::Index from = row_of(part_began_s[part]);
    const Eigen::Index until =
        part + 1 < part_began_s.size() ? row_of(part_began_s[part + 1]) : replay.intervals();
    Eigen::MatrixXd& gram = rehearsal.parts[part];
    add_rows(linear.design, from * kEvidenceChannels, (until - from) * kEvidenceChannels, gram);
    const Eigen::Index fixes = replay.intervals() * kEvidenceChannels;
    for (std::size_t i = 0; i < readings.fixes.size(); ++i) {
      if (part_at(part_began_s, readings.fixes[i].time_s) != static_cast<std::ptrdiff_t>(part)) continue;
      add_rows(linear.design, fixes + static_cast<Eigen::Index>(i) * kFixChannels, kFixChannels, gram);
    }
  });
  return rehearsal;
}

}  // namespace navcal::gap

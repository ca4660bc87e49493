// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gap/data/innovations.h"
#include "gap/design/hypothesis.h"
#include "gap/design/next_mission.h"
#include "gap/design/planned_run.h"

namespace navcal::gap {

/// Time spent in each regime of the vehicle: bands of shaft speed, rate of turn, depth, pitch, roll, heading, and
/// time since the start (which the temperature of the electronics follows), and bands of rate of turn at each band
/// of shaft speed.
using Coverage = Eigen::VectorXd;  // seconds

[[nodiscard]] Coverage no_coverage();
[[nodiscard]] Coverage coverage_of(const Trajectory10Hz& course);
[[nodiscard]] Coverage coverage_of(const PlannedPath& path, double from_s, double until_s);

/// Loss that falls as unseen bands are visited: the sum of exp(-t / 5 s) over all bands.
[[nodiscard]] double coverage_loss(const Coverage& seconds);

/// Bands with less than 2 s before and at least 2 s after, in words: "depth 3 to 4 m".
[[nodiscard]] std::vector<std::string> newly_covered(const Coverage& before, const Coverage& after);

/// What a mission contributes: the Gram matrix of its design and the regimes that it visits.
struct Contribution {
  Eigen::MatrixXd gram;
  Coverage coverage;

  Contribution& operator+=(const Contribution& other) {
    gram += other.gram;
    coverage += other.coverage;
    return *this;
  }
};

/// The question that the next mission is to answer, from the recordings so far.
struct Question {
  MissionPurpose purpose = MissionPurpose::separate;
  std::vector<Hypothesis> hypotheses;  ///< most probable first; the last may be no effect
  Contribution so_far;                 ///< of the recordings
  const Library& library;
  Priors priors;

  /// Loss of a planned mission; smaller is better.
  [[nodiscard]] double loss(const Contribution& planned) const;
  /// Point of linearisation of rehearsals (RehearsalProblem::at): curved members of the sets at their estimates.
  [[nodiscard]] Eigen::VectorXd curved_estimates() const;
};

/// Gram matrix with the biases of the gyros projected out: each recording has its own.
[[nodiscard]] Eigen::MatrixXd without_biases(const Eigen::MatrixXd& gram);

[[nodiscard]] Question question_of(const Study& study);

}  // namespace navcal::gap

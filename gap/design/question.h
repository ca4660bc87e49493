// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/design/coverage.h"
#include "gap/design/hypothesis.h"
#include "gap/design/next_mission.h"

namespace navcal::gap {

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

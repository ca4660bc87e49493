// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gap/data/innovations.h"
#include "gap/design/hypothesis.h"
#include "gap/design/next_mission.h"
#include "gap/design/planned_run.h"
#include "gap/thresholds.h"

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
  std::vector<std::string> names;      ///< of all effects
  std::vector<TestedParameter> tested;
  Eigen::VectorXd tolerances;  ///< standard deviations of all unknowns without effects
  /// Information that a mission adds to that of the recordings so far, by its Gram matrix: other unknowns are new
  /// in each one.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> adds;
  /// Gram matrix of a mission as the hypotheses have it; they may have fewer unknowns than a mission.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> told_by = [](const auto& gram) { return gram; };
  Eigen::Index unknowns = 0;            ///< of a mission
  double named_from = 1 - kMostRivals;  ///< probability of a set that makes it the answer

  /// Loss of a planned mission; smaller is better.
  [[nodiscard]] double loss(const Contribution& planned) const;
  /// Smallest strengths of the tested parameters that stand out after a mission with this Gram matrix.
  [[nodiscard]] Eigen::VectorXd smallest_strengths(const Eigen::MatrixXd& planned) const;
};

/// Writes names, tested parameters, tolerances and unknowns of a question, by a library and its priors.
void ask_about(const Library& library, const Priors& priors, Question& question);

/// Point of linearisation of rehearsals (RehearsalProblem::at): curved members of the sets at their estimates.
[[nodiscard]] Eigen::VectorXd curved_estimates(const Question& question, const Library& library);

struct WeighedSet {
  EffectSubset effects;
  double probability;
};
/// The first six sets of at least this probability, each once, and no effect; their probabilities add up to 1.
[[nodiscard]] std::vector<WeighedSet> weighed(std::span<const WeighedSet> sets, double counted_from);

[[nodiscard]] Question question_of(const Study& study);

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gap/verdict/find_effects.h"

namespace navcal::gap {

/// Rows of each recording in the joint residuals, the first recording first.
[[nodiscard]] std::vector<Eigen::Index> rows_of_recordings(const DiagnosisProblem& problem);

/// Compares what each of several recordings says by itself of the effects that were found in all together. The
/// estimates of one effect differ significantly if their chi-square has a small p-value. `names`: of the
/// recordings. Fills `answer.recordings` and `answer.differences`.
void compare_recordings(const DiagnosisProblem& problem, const FoundEffects& result,
                        std::span<const std::string> names, Diagnosis& answer);

/// Estimate of one effect by one recording alone.
struct OwnEstimate {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};
/// Writes what each of `answer.recordings` says of one effect, and whether that differs by `estimates`, which may
/// be in other units.
void write_own_estimates(std::vector<EffectFinding> findings, const std::vector<OwnEstimate>& estimates,
                         Diagnosis& answer);
/// Writes a remark on each of `answer.recordings` that was diagnosed alone, and the sentence of an unknown verdict
/// where they do not agree.
void write_alone(Diagnosis& answer);

/// Diagnoses each recording alone, and writes which effects it would name into `answer.recordings`: where effects
/// do not explain all recordings together, this shows what holds in one and not in another.
void search_apart(const DiagnosisProblem& problem, Diagnosis& answer);

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "gap/inference/whitening.h"
#include "gap/verdict/diagnosis.h"
#include "gap/verdict/find_effects.h"

namespace navcal::gap {

/// Begin of the piece of a mission in which whitened residuals have the largest power, s after the first interval.
/// `fix_times_s`: of the layout's fixes, s after the first interval. The residuals are as a Whitening returns
/// them.
[[nodiscard]] double loudest_piece_s(const Eigen::VectorXd& residual, const Layout& layout,
                                     const std::vector<double>& fix_times_s, double length_s);

/// Finds the instruments and forces whose error describes the residuals of all recordings best, and writes them to
/// `answer.sources`. Of several recordings each has an error of its own, and the gains add up. If the verdict is
/// unknown, the first one becomes `answer.proposal`, judged on the recordings held out.
void write_sources(const DiagnosisProblem& problem, const FoundEffects& found,
                   const std::vector<std::unique_ptr<Prepared>>& holdouts, Diagnosis& answer);

/// Sorts `answer.where`: cells of the channel in which the error enters come first. If that channel has no
/// significant cell, the error itself becomes the first entry. Nothing changes where no source describes the
/// residuals clearly.
void put_source_first(Diagnosis& answer);

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <vector>

#include "diagnosis/causes.h"
#include "diagnosis/recording_fit.h"
#include "gap/inference/evidence.h"

namespace navcal::diagnosis {

/// Causes that act together: indices into CauseLibrary::causes, in order.
using CauseSet = std::vector<std::size_t>;

/// Standard deviations of the priors of all columns, about zero. Spike: a vehicle within tolerance. Typical: what
/// strength 1 is, of columns that belong to a cause.
struct ColumnPriors {
  Eigen::VectorXd spike, typical;
};

struct ScoredSet {
  CauseSet causes;  ///< empty: no effect
  double log_odds = 0;
  double probability = 0;
};

struct CauseSearchResult {
  std::vector<ScoredSet> sets;  ///< most probable first
  RecordingFit best;            ///< fitted with the causes of the first one
  Eigen::VectorXd mean, std;    ///< posterior of all columns with that set
};

/// Log evidence of a set of causes by a linearised recording, nats, up to a constant that all sets and all
/// linearisations share: a mixture of the strengths kMemberStrengths (spike-and-slab regression, docs/gap.md).
class SetEvidence {
 public:
  /// The library and the priors must outlive it.
  SetEvidence(const LinearRecording& linear, const CauseLibrary& library, const ColumnPriors& priors);
  [[nodiscard]] double operator()(const CauseSet& set) const;

  struct Posterior {
    Eigen::VectorXd mean, std;
  };
  [[nodiscard]] Posterior posterior(const CauseSet& set) const;
  /// Expected evidence, nats, of a cause at its typical strength that the columns of `others` cannot take over.
  [[nodiscard]] double separation(std::size_t cause, const CauseSet& others) const;

 private:
  [[nodiscard]] double log_prior(std::size_t size) const;
  [[nodiscard]] double gain_of_signs(const CauseSet& set, const std::vector<Eigen::Index>& members,
                                     const Eigen::VectorXd& slab) const;

  const CauseLibrary& library_;
  const ColumnPriors& priors_;
  gap::Evidence evidence_;
  double base_;
};

/// Searches sets of at most kMostEffects causes. All singles and pairs are scored with the linearisation about the
/// nominal vehicle; the leaders of each size are fitted again at their own estimate, because large effects are not
/// linear, and score their larger neighbours.
[[nodiscard]] CauseSearchResult search_causes(const FittedRecording& recording, const RecordingFit& nominal,
                                              const CauseLibrary& library, const ColumnPriors& priors,
                                              const Progress& progress);

}  // namespace navcal::diagnosis

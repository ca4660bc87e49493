// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "diagnosis/causes.h"
#include "diagnosis/recording_fit.h"

namespace navcal::diagnosis {

/// Causes that act together: indices into CauseLibrary::causes, in order.
using CauseSet = std::vector<std::size_t>;

/// Two causes that move the same thing in the same way: the arm between the centres, the force of one actuator.
[[nodiscard]] bool are_one(const Cause& a, const Cause& b);

struct ScoredSet {
  CauseSet causes;  ///< empty: no effect
  double log_odds = 0;
  double probability = 0;
};

struct CauseSearchResult {
  std::vector<ScoredSet> sets;  ///< most probable first
  RecordingFit best;            ///< fitted with the causes of the first one
  Likelihood none;              ///< of departures without a cause, about the best of them
  Likelihood changes;           ///< of the nominal vehicle, in `best`
};

/// A change near which another one is looked for: the prior's mean is moved there by a share of the way.
struct Anchor {
  Eigen::VectorXd change = {};
  double share = 0;
};

/// Log evidence of sets of causes by the likelihood of changes of the nominal vehicle, nats: a mixture of the
/// strengths kMemberStrengths (docs/gap.md, "Vehicles with a layout").
class SetEvidence {
 public:
  /// The library must outlive it.
  SetEvidence(Likelihood changes, const CauseLibrary& library) : changes_(std::move(changes)), library_(library) {}

  /// Up to a constant that all sets and all linearisations of a recording share.
  [[nodiscard]] double operator()(const CauseSet& set) const { return changes_.evidence() + gain(set); }
  /// Over that of no cause.
  [[nodiscard]] double gain(const CauseSet& set) const;

  /// Of the set's columns, in their order; with the widest prior.
  struct Posterior {
    std::vector<Eigen::Index> columns;
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;

    [[nodiscard]] double std(Eigen::Index i) const { return std::sqrt(covariance(i, i)); }
    /// All columns, those of no member zero.
    [[nodiscard]] Eigen::VectorXd among(Eigen::Index count) const;
  };
  [[nodiscard]] Posterior posterior(const CauseSet& set, const Anchor& anchor = {}) const;

 private:
  [[nodiscard]] double gain(const CauseSet& set, double strength) const;

  Likelihood changes_;
  const CauseLibrary& library_;
};

/// Change of the nominal vehicle by the likelihood of changes.
using ChangeOf = std::function<Eigen::VectorXd(const Likelihood&, const Anchor&)>;
/// Log probability of a change before the recording, but for a constant.
using LogPriorOf = std::function<double(const Eigen::VectorXd&)>;
/// Departures of each recording, and the part of them that is the change of the nominal vehicle.
struct Departures {
  Eigen::VectorXd at, change;
};
/// A recording linearised again and again where it says that its vehicle is, until its evidence settles. nullopt:
/// a vehicle could not have moved so. Only recordings that have settled alike compare.
[[nodiscard]] std::optional<RecordingFit> settled(
    const RecordingModel& recording, const JointPrior& prior, Departures from, const ChangeOf& change_of,
    const LogPriorOf& log_prior_of = [](const auto&) { return 0.0; });

/// Searches sets of at most kMostEffects causes. All singles and pairs are scored with the linearisation of the
/// nominal vehicle; the leaders are fitted again at their own estimate, because large effects are not linear, and
/// score their larger neighbours. Behind a gap that leads the nominal vehicle's filter astray, the recording holds
/// the gains of the best set. Throws std::invalid_argument where the nominal vehicle cannot follow.
[[nodiscard]] CauseSearchResult search_causes(RecordingModel& recording, const JointPrior& prior,
                                              const CauseLibrary& library, const Progress& progress);

}  // namespace navcal::diagnosis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "gap/design/alphabet.h"
#include "gap/design/hypothesis.h"
#include "gap/design/planned_run.h"
#include "gap/inference/whitening.h"

namespace navcal::gap {

/// Gram matrices of the design of a simulated mission.
struct Rehearsal {
  Eigen::MatrixXd gram;                ///< of the whole mission
  std::vector<Eigen::MatrixXd> parts;  ///< of each part
};

/// The nominal vehicle with its instruments, with which missions are rehearsed.
class Rehearser {
 public:
  Rehearser() = default;
  Rehearser(const Rehearser&) = delete;
  Rehearser& operator=(const Rehearser&) = delete;
  virtual ~Rehearser() = default;

  [[nodiscard]] virtual Regime regime(const config::MissionLimits& limits) const = 0;
  /// Whether the vehicle has what the steps of a mission need.
  [[nodiscard]] virtual bool can(const config::Mission& mission) const = 0;
  /// True path; `changed`: of a vehicle with the effects of this hypothesis. Throws sim::UnstableVehicle.
  [[nodiscard]] virtual PlannedPath path(const config::Mission& mission, double longest_s,
                                         const Hypothesis* changed = nullptr) const = 0;
  /// Simulates a mission, replays and linearises it. `part_began_s`: the begins of its parts, in order; each ends
  /// where the next begins, the last with the mission. Throws sim::UnstableVehicle.
  [[nodiscard]] virtual Rehearsal rehearse(const config::Mission& mission, double duration_s,
                                           std::span<const double> part_began_s) const = 0;
};

/// A vehicle of one propeller and three fins, with all that its rehearsals need. What the references name must
/// outlive it.
struct RehearsalProblem {
  const config::VehicleSettings& vehicle;
  const Library& library;
  const Whitening& whitening;  ///< of the recordings' null bank
  PlannedInstruments instruments;
  /// Point of linearisation: zero but for curved effects (Library::is_curved), whose regressors at zero do not
  /// describe their usual strength.
  Eigen::VectorXd at;
  unsigned threads = 1;
};

class ReferenceRehearser final : public Rehearser {
 public:
  explicit ReferenceRehearser(RehearsalProblem problem) : problem_(std::move(problem)) {}

  [[nodiscard]] Regime regime(const config::MissionLimits& limits) const override {
    return regime_of(problem_.vehicle, limits);
  }
  [[nodiscard]] bool can(const config::Mission& /*mission*/) const override { return true; }
  [[nodiscard]] PlannedPath path(const config::Mission& mission, double longest_s,
                                 const Hypothesis* changed = nullptr) const override;
  [[nodiscard]] Rehearsal rehearse(const config::Mission& mission, double duration_s,
                                   std::span<const double> part_began_s) const override;

 private:
  RehearsalProblem problem_;
};

/// Part of a mission that a time belongs to; -1 before the first.
[[nodiscard]] std::ptrdiff_t part_at(std::span<const double> began_s, double time_s);

}  // namespace navcal::gap

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "diagnosis/recording_fit.h"
#include "gap/design/rehearser.h"

namespace navcal::diagnosis {

/// Rehearses missions of the vehicle of a layout, with the instruments of a recording: their places, rates and
/// noises. The readings have no noise, the unknowns are those of one recording.
class LayoutRehearser final : public gap::Rehearser {
 public:
  /// All that is referred to must outlive it. `nominal`: departures of the nominal vehicle. `change_of`:
  /// departures that a hypothesis adds.
  LayoutRehearser(const config::Layout& layout, const CauseLibrary& library, const FilteredSource& source,
                  const identify::RecordedMotion& like, const Eigen::VectorXd& nominal,
                  std::function<Eigen::VectorXd(const gap::Hypothesis&)> change_of)
      : library_(library), source_(source), like_(like), nominal_(nominal), change_of_(std::move(change_of)),
        layout_(with(layout, nominal)) {}

  /// Throws std::invalid_argument where no mission can be steered.
  [[nodiscard]] gap::Regime regime(const config::MissionLimits& limits) const override;
  [[nodiscard]] bool can(const config::Mission& mission) const override;
  [[nodiscard]] gap::PlannedPath path(const config::Mission& mission, double longest_s,
                                      const gap::Hypothesis* changed = nullptr) const override;
  /// Throws std::invalid_argument where the filter cannot follow.
  [[nodiscard]] gap::Rehearsal rehearse(const config::Mission& mission, double duration_s,
                                        std::span<const double> part_began_s) const override;

  /// A recording of a mission of the nominal vehicle, without noise. Throws sim::UnstableVehicle.
  [[nodiscard]] identify::RecordedMotion sailed(const config::Mission& mission, double duration_s) const;

 private:
  [[nodiscard]] config::Layout with(const config::Layout& layout, const Eigen::VectorXd& departures) const;

  const CauseLibrary& library_;
  const FilteredSource& source_;
  const identify::RecordedMotion& like_;
  const Eigen::VectorXd nominal_;
  std::function<Eigen::VectorXd(const gap::Hypothesis&)> change_of_;
  config::Layout layout_;
};

}  // namespace navcal::diagnosis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "config/vehicle.h"
#include "gap/data/mission.h"

namespace navcal::gap {

/// What the recorded commands are worth.
struct CommandCheck {
  /// Time by which the vehicle follows later than the recorded commands say, s: the lag with the greatest
  /// cross-correlation. With reports, between the reported fins and those of nominal servos that obey; without,
  /// between the measured yaw rate and that of the nominal vehicle under these commands, which takes the lag of a
  /// vehicle that is not nominal for a delay. Empty where the fins hardly moved or nothing correlates.
  std::optional<double> delay_s;
  /// Correlation at that lag, or the greatest where it is too small for a delay; empty where the fins hardly moved
  /// or nothing measures their consequence.
  std::optional<double> correlation;
  bool by_reports = false;  ///< the delay is that of reported fins
  /// Share of the time in which a fin stands at its limit, by commands, else by reports; 0 to 1.
  double saturated = 0;
  /// Share of the time in which no command was recorded for kSilent_s although the reported fins moved; 0 to 1.
  double unrecorded = 0;
};

/// Checks the commands of a mission with motor reports, reported or computed from the commands.
[[nodiscard]] CommandCheck check_commands(const Mission& mission, const config::VehicleSettings& vehicle);

}  // namespace navcal::gap

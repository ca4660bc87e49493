// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "validation/fleet_cases.h"

namespace navcal::validation {

/// Swims all missions of a fleet in the reference simulator and writes their captures below the folder, which must
/// be new or empty, and a vehicle.toml with the density of the water. Nothing in or about them tells of the
/// causes. `progress` gets 0 to 1. Throws std::invalid_argument (the folder), analysis::Failure,
/// std::system_error.
void write_fleet(const FleetCase& fleet, const std::filesystem::path& folder, unsigned threads,
                 const std::function<void(double)>& progress);

/// Outcomes of the sealed causes, and what was named beside them.
struct FleetScore {
  /// Counts by group ("vehicle", "vehicle, begins", "design", "design, weak", "day") and outcome ("right", "wrong
  /// level", "undecided", "missed").
  std::map<std::string, std::map<std::string, int>> causes;
  int begun = 0,
      begun_right = 0;  ///< causes that begin and were found, and those whose mission is right within one
  int named = 0, named_wrong = 0;  ///< causes that the answer names, and those that are not there
  int foreign = 0,
      foreign_unknown = 0;           ///< vehicles with an effect that no library holds, and those called unknown
  int sound = 0, sound_unknown = 0;  ///< vehicles without one, and those called unknown
  int parameters = 0, parameters_within_two = 0;  ///< of causes that are right: errors within two standard errors
};

/// Compares the answer of `navcal fleet causes --json` with the truth. A named cause is right if effect, level and
/// vehicle or day are; it is wrong if no true cause has that effect in its missions. Throws std::runtime_error for
/// an answer of another shape.
[[nodiscard]] FleetScore score_of(const FleetTruth& truth, std::string_view answer_json);

/// The score for people.
[[nodiscard]] std::string score_text(const FleetScore& score);

}  // namespace navcal::validation

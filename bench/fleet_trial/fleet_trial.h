// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "validation/missions.h"
#include "validation/reference/effects.h"
#include "validation/reference/run.h"

namespace navcal::bench {

/// What a cause of a fleet belongs to.
enum class FleetLevel : std::uint8_t { vehicle, design, day };
/// "vehicle", "design", "day".
[[nodiscard]] std::string_view name_of(FleetLevel level);

/// One sealed cause: an effect of one vehicle (in all missions, or from one on), of all of them, or of a day.
struct FleetCause {
  FleetLevel level = FleetLevel::vehicle;
  int vehicle = 0;  ///< from 1; of `vehicle`
  int day = 0;      ///< from 1: the day of `day`, or the first one on which an effect of a vehicle acts
  double strength = 0;
  bool is_foreign = false;  ///< no library holds it
  reference::Effect effect;

  [[nodiscard]] bool acts_in(int of_vehicle, int on_day) const;
};

struct FleetTrialOptions {
  std::uint64_t seed = 1;
  int vehicles = 20;
  int days = 10;     ///< each vehicle sails one mission on each
  int minutes = 10;  ///< of a mission
  double strength = 0.2;
  double weak = 0.05;  ///< strength of a second effect of the design, which only all missions together show
};

/// A fleet as it is drawn: the truth, which the answer must not know.
struct FleetCase {
  FleetTrialOptions options;
  validation::TrialPlace place;
  std::vector<FleetCause> causes;
  /// Each vehicle with its own tolerance, 2 % of everything, and without causes.
  std::vector<reference::VehicleUnderTest> vehicles;
};

/// Of the vehicles, three in ten have an effect in all missions, two in ten one that begins in the course of them,
/// one in ten an effect that no library holds. The design has one effect of `strength` and one of `weak`. Three
/// days in ten have an effect of the water or of the Earth's field. The same options give the same fleet on every
/// machine.
[[nodiscard]] FleetCase drawn_fleet(const FleetTrialOptions& options);

/// The vehicle as it is on one day, causes and all.
[[nodiscard]] reference::VehicleUnderTest vehicle_on(const FleetCase& fleet, int vehicle, int day);
/// Folder and file of a mission, neutral: "v07/day-03.cap".
[[nodiscard]] std::string mission_name(int vehicle, int day);
[[nodiscard]] std::string vehicle_name(int vehicle);

/// The truth as one JSON object, and back. The reverse throws std::runtime_error.
[[nodiscard]] std::string truth_text(const FleetCase& fleet);
struct FleetTruth {
  int vehicles = 0, days = 0;
  std::int64_t begin_ns = 0;
  std::vector<FleetCause> causes;
};
[[nodiscard]] FleetTruth read_fleet_truth(std::string_view json);

/// Sails all missions of a fleet in the reference simulator and writes their captures below the folder, which must
/// be new or empty, and a vehicle.toml with the density of the water. Nothing in or about them tells of the
/// causes. `progress` gets 0 to 1. Throws std::invalid_argument (the folder), base::Failure,
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

}  // namespace navcal::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "validation/missions.h"
#include "validation/reference/effects.h"
#include "validation/reference/run.h"

namespace navcal::validation {

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
  TrialPlace place;
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

}  // namespace navcal::validation

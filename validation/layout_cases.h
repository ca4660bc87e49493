// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "validation/cases.h"
#include "validation/reference/thrusters/swim.h"

namespace navcal::validation {

/// A shipped layout, or one of the user's: `name` for people, and the file's text.
struct NamedLayout {
  std::string name, text;
};

/// A trial of vehicles with thrusters: the same numbers give the same vehicles and cases on every machine.
struct LayoutTrial {
  std::vector<NamedLayout> layouts;  ///< vehicles take them by turns, and cases the vehicles
  std::uint64_t seed = 1;
  int vehicles = 3, nominal = 3;  ///< `nominal`: recordings without an effect, of each vehicle
  double minutes = 3;             ///< of a recording
  double layout_error = 0.05;     ///< of the layouts: reference::thrusters::perturbed
  double unmodelled = 1;          ///< factor on the spreads of reference::thrusters::Nature
};

/// A recording that is to be made.
struct LayoutRecording {
  reference::thrusters::Swim swim;
  reference::thrusters::CraftUnderTest craft;  ///< the vehicle on this day
  std::uint64_t seed = 0;
};

/// One vehicle: its layout is off by the errors of an identification that is yet to come.
struct LayoutVehicle {
  int number = 1;  ///< from 1
  NamedLayout layout;
  double layout_error = 0;
  reference::thrusters::CraftUnderTest craft;
  TrialPlace place;
  std::vector<LayoutRecording> nominals;  ///< without an effect, each on a day of its own
  std::string truth;                      ///< what the numbers of the vehicle really are, as JSON
};

/// Part of a case: whose it is, and its recordings (to be diagnosed, and two held out).
struct LayoutCase {
  std::shared_ptr<const LayoutVehicle> vehicle;
  std::array<LayoutRecording, 3> recordings;
};

/// How much a vehicle changes from one day to the next: reference::thrusters::perturbed.
inline constexpr double kDayTolerance = 0.005;

/// Throws std::invalid_argument for a layout that cannot be read or has other actuators than thrusters, or more
/// than eight of them.
[[nodiscard]] LayoutVehicle drawn_vehicle(const LayoutTrial& trial, int number);
/// The arm follows from the number; effects come by turns, so that each comes once before any comes again.
/// `attempt`: another draw of the same case, for effects with which the vehicle cannot swim; after six of them the
/// next effect is drawn.
[[nodiscard]] TrialCase drawn_layout_case(const LayoutTrial& trial, int number,
                                          const std::shared_ptr<const LayoutVehicle>& vehicle, int attempt);
/// Cases with which their vehicles can swim. Throws as drawn_vehicle(), and base::Failure where a vehicle is
/// always lost, or when interrupted. `progress`: of the share that is done.
[[nodiscard]] std::vector<TrialCase> drawn_layout_cases(const LayoutTrial& trial, const std::vector<int>& numbers,
                                                        const std::function<void(double)>& progress);

/// Text of the vehicle's layout as a data sheet: with standard errors that fit its error (docs/trial.md). A list
/// over several lines gets none.
[[nodiscard]] std::string data_sheet(const LayoutVehicle& vehicle);

}  // namespace navcal::validation

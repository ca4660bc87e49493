// SPDX-License-Identifier: Apache-2.0
#include "validation/layout_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <ranges>
#include <sstream>
#include <stdexcept>

#include "base/failure.h"
#include "record/json/put_members.h"
#include "validation/recordings.h"
#include "validation/reference/effects.h"
#include "validation/reference/thrusters/outputs.h"

namespace navcal::validation {
namespace {

namespace thrusters = reference::thrusters;
using nlohmann::ordered_json;

// Streams of the dice: vehicles, days, cases and missions draw apart.
constexpr std::uint64_t kVehicleStream = 2ULL << 40U, kDayStream = 3ULL << 40U, kCaseStream = 4ULL << 40U,
                        kTurnStream = 5ULL << 40U, kSwimStream = 6ULL << 40U, kMissionStream = 7ULL << 40U;
constexpr double kInstrumentTolerance = 0.02;
/// After so many draws of an effect with which a vehicle cannot swim comes the next one.
constexpr int kAttemptsOfAnEffect = 6, kMostAttempts = 20;

/// Effects of thrusters and vehicle, or of instruments; of the library, or those outside it; in an order of the
/// seed's, over and over.
const thrusters::CraftEffectKind& effect_in_turn(std::uint64_t seed, TrialArm arm, bool is_instrument, int place) {
  /// Each has streams of its own.
  constexpr std::array kOrder{TrialArm::nulls, TrialArm::single_half, TrialArm::single, TrialArm::single_double,
                              TrialArm::pairs, TrialArm::removed,     TrialArm::foreign};
  std::vector<const thrusters::CraftEffectKind*> kinds;
  for (const thrusters::CraftEffectKind& kind : thrusters::craft_effects()) {
    if (kind.in_library == (arm != TrialArm::foreign) &&
        (kind.scope == thrusters::Scope::instrument) == is_instrument)
      kinds.push_back(&kind);
  }
  const auto of_arm = static_cast<std::uint64_t>(std::ranges::find(kOrder, arm) - kOrder.begin());
  return *kinds[in_turn(seed, kTurnStream + 2 * of_arm + (is_instrument ? 1 : 0), 64, place, kinds.size())];
}

/// Two of three single effects are the vehicle's, the third an instrument's; of a pair, one is of each.
std::vector<thrusters::CraftEffect> drawn_effects(std::uint64_t seed, int number, int attempt,
                                                  const thrusters::Plan& layout, reference::Rng& dice) {
  const TrialArm arm = arm_of_case(number, layout_round());
  const int turn = ordinal_in_arm(number, layout_round());
  std::vector<thrusters::CraftEffect> effects;
  const auto add = [&](bool is_instrument, int place) {
    const thrusters::CraftEffectKind& kind =
        effect_in_turn(seed, arm, is_instrument, place + attempt / kAttemptsOfAnEffect);
    effects.push_back(thrusters::drawn(kind, facts_of(arm).strength, layout, dice));
  };
  if (arm == TrialArm::nulls) return effects;
  if (arm == TrialArm::pairs) {
    add(false, turn);
    add(true, turn);
  } else if (turn % 3 == 2) {
    add(true, turn / 3);
  } else {
    add(false, turn - turn / 3);
  }
  return effects;
}

TrialEffect trial_effect(const thrusters::CraftEffect& effect, const thrusters::Plan& layout) {
  TrialEffect made{effect.name, effect.parameters, effect.parameters, effect.of, {}};
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
    if (effect.of == "thruster." + std::to_string(i + 1)) made.of_name = layout.thrusters[i].name;
  }
  return made;
}

ordered_json numbers_of(const reference::Matrix6& matrix) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index i = 0; i < 36; ++i) rows.push_back(matrix(i / 6, i % 6));
  return rows;
}

ordered_json numbers_of(const reference::Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// What the vehicle really is, in the terms of its layout; of thrusters the factor on the layout's force.
ordered_json json_of(const thrusters::Plan& real, const thrusters::Plan& layout) {
  ordered_json each = ordered_json::array();
  for (std::size_t i = 0; i < real.thrusters.size(); ++i) {
    const thrusters::PlannedThruster &is = real.thrusters[i], &stated = layout.thrusters[i];
    each.push_back({{"name", is.name},
                    {"force_scale", is.bollard_N(is.high, real.density_kg_m3) /
                                        stated.bollard_N(stated.high, layout.density_kg_m3)},
                    {"lag_s", is.lag_s},
                    {"torque_m", is.torque_arm_m},
                    {"place_m", numbers_of(is.place_m)},
                    {"direction", numbers_of(is.direction)}});
  }
  const auto& I = real.inertia_kg_m2;
  return {{"mass_kg", real.mass_kg},
          {"buoyancy_N", real.buoyancy_N},
          {"gravity_centre_m", numbers_of(real.gravity_centre_m)},
          {"inertia_kg_m2", {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)}},
          {"added_mass", numbers_of(real.added_mass)},
          {"linear", numbers_of(real.linear)},
          {"quadratic", numbers_of(real.quadratic)},
          {"axial_kg_m", real.axial_kg_m},
          {"cross_flow", real.crossflow},
          {"thrusters", each}};
}

std::string vehicle_truth(const LayoutVehicle& vehicle, const LayoutTrial& trial) {
  const thrusters::Nature& nature = vehicle.craft.nature;
  ordered_json truth{{"number", vehicle.number}, {"layout", vehicle.layout.name}};
  NAVCAL_PUT_MEMBERS(truth, trial, layout_error, unmodelled);
  truth["day_tolerance"] = kDayTolerance;
  truth["real"] = json_of(vehicle.craft.real, vehicle.craft.layout);
  ordered_json& by_nature = truth["nature"];
  NAVCAL_PUT_MEMBERS(by_nature, nature, resistance, overshoot, jet_loss, strips, current_m_s, wave_m);
  by_nature["doppler_scale"] = vehicle.craft.doppler.scale;
  NAVCAL_PUT_MEMBERS(by_nature, vehicle.craft, compass_clock, card_clock);
  return truth.dump();
}

/// Seeds of missions by what they belong to: vehicle and day of nominal ones, case and letter of others.
std::uint64_t mission_seed(std::uint64_t seed, std::uint64_t series, int number, int part) {
  reference::Rng dice(seed, kMissionStream + (series << 32U) + (static_cast<std::uint64_t>(number) << 8U) +
                                static_cast<std::uint64_t>(part));
  return dice.bits();
}

/// A mission of this vehicle, drawn by its seed. `day` counts from that of the place.
LayoutRecording recording_of(const LayoutVehicle& vehicle, thrusters::CraftUnderTest craft,
                             std::uint64_t mission_seed, double minutes, int day) {
  reference::Rng dice(mission_seed, kSwimStream);
  thrusters::Swim swim;
  swim.start_ns = vehicle.place.begin_ns + day * kDay_ns;
  swim.duration_s = 60 * minutes;
  swim.legs = thrusters::drawn_legs(vehicle.craft.layout, swim.duration_s, dice);
  swim.start.position_m.z() = swim.legs.front().depth_m;
  swim.start.world_from_body = reference::attitude(0, 0, dice.uniform(0, 2 * std::numbers::pi));
  swim.anchorage = vehicle.place.anchorage;
  swim.waters = vehicle.place.waters;
  return {std::move(swim), std::move(craft), mission_seed};
}

template <class Recordings>
bool can_swim(const Recordings& recordings) {
  return std::ranges::none_of(recordings,
                              [](const LayoutRecording& recording) { return capture_of(recording).empty(); });
}

TrialCase swimming_case(const LayoutTrial& trial, int number,
                        const std::shared_ptr<const LayoutVehicle>& vehicle) {
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    TrialCase drawn = drawn_layout_case(trial, number, vehicle, attempt);
    if (can_swim(drawn.on_layout->recordings)) return drawn;
  }
  throw base::Failure(
      base::Exit::failed,
      fmt::format("case {}: {} draws of its effects, and the vehicle was lost with each", number, kMostAttempts));
}

}  // namespace

LayoutVehicle drawn_vehicle(const LayoutTrial& trial, int number) {
  LayoutVehicle vehicle;
  vehicle.number = number;
  vehicle.layout = trial.layouts[static_cast<std::size_t>(number - 1) % trial.layouts.size()];
  vehicle.layout_error = trial.layout_error;
  thrusters::CraftUnderTest& craft = vehicle.craft;
  try {
    craft.layout = thrusters::plan_of(vehicle.layout.text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(vehicle.layout.name + ": " + error.what());
  }
  if (craft.layout.thrusters.size() > thrusters::kOutputChannels)
    throw std::invalid_argument(vehicle.layout.name + ": more than eight thrusters cannot be reported");
  reference::Rng dice(trial.seed, kVehicleStream + static_cast<std::uint64_t>(number));
  craft.real = thrusters::perturbed(craft.layout, trial.layout_error, dice);
  craft.nature.resistance = dice.uniform(0.2, 0.4);
  craft.nature.overshoot = trial.unmodelled * dice.uniform(0.05, 0.2);
  craft.nature.jet_loss = std::min(trial.unmodelled * dice.uniform(0, 0.04), 1.0);
  craft.nature.strips = std::min(trial.unmodelled * dice.uniform(0, 0.1), 1.0);
  craft.nature.current_m_s *= trial.unmodelled;
  craft.nature.wave_m *= trial.unmodelled;
  craft.doppler = {dice.normal(0.003), dice.normal(1e-4)};
  reference::apply_tolerance(kInstrumentTolerance, craft.differences.instruments, dice);
  constexpr double kGreatestClockError = 0.01;
  craft.compass_clock = dice.uniform(-kGreatestClockError, kGreatestClockError);
  craft.card_clock = dice.uniform(-kGreatestClockError, kGreatestClockError);
  vehicle.place = drawn_place(trial.seed, number);
  // It is trimmed where it swims.
  vehicle.place.waters.density_kg_m3 = craft.layout.density_kg_m3;
  for (int day = 1; day <= trial.nominal; ++day) {
    reference::Rng dice_of_day(
        trial.seed, kDayStream + (static_cast<std::uint64_t>(number) << 20U) + static_cast<std::uint64_t>(day));
    thrusters::CraftUnderTest that_day = craft;
    that_day.real = thrusters::perturbed(craft.real, kDayTolerance, dice_of_day);
    vehicle.nominals.push_back(
        recording_of(vehicle, that_day, mission_seed(trial.seed, 0, number, day), trial.minutes, day));
  }
  vehicle.truth = vehicle_truth(vehicle, trial);
  return vehicle;
}

TrialCase drawn_layout_case(const LayoutTrial& trial, int number,
                            const std::shared_ptr<const LayoutVehicle>& vehicle, int attempt) {
  reference::Rng dice(
      trial.seed, kCaseStream + (static_cast<std::uint64_t>(number) << 8U) + static_cast<std::uint64_t>(attempt));
  TrialCase drawn;
  drawn.number = number;
  drawn.arm = arm_of_case(number, layout_round());
  drawn.minutes = trial.minutes;
  drawn.place_number = vehicle->number;
  drawn.place = vehicle->place;
  thrusters::CraftUnderTest craft = vehicle->craft;
  craft.real = thrusters::perturbed(craft.real, kDayTolerance, dice);
  for (const auto& effect : drawn_effects(trial.seed, number, attempt, craft.layout, dice)) {
    thrusters::add(effect, craft.layout, craft.differences);
    drawn.effects.push_back(trial_effect(effect, craft.layout));
  }
  if (drawn.arm == TrialArm::removed) drawn.excluded = drawn.effects.front().name;
  auto on_layout = std::make_shared<LayoutCase>();
  on_layout->vehicle = vehicle;
  for (std::size_t i = 0; i < drawn.mission_seeds.size(); ++i) {
    drawn.mission_seeds[i] = mission_seed(trial.seed, 1, number, static_cast<int>(i));
    on_layout->recordings[i] =
        recording_of(*vehicle, craft, drawn.mission_seeds[i], trial.minutes, trial.nominal + number);
  }
  drawn.on_layout = std::move(on_layout);
  return drawn;
}

std::vector<TrialCase> drawn_layout_cases(const LayoutTrial& trial, const std::vector<int>& numbers,
                                          const std::function<void(double)>& progress) {
  std::map<int, std::shared_ptr<const LayoutVehicle>> vehicles;
  std::vector<TrialCase> cases;
  for (const int number : numbers) {
    auto& vehicle = vehicles[(number - 1) % trial.vehicles + 1];
    if (vehicle == nullptr) {
      vehicle = std::make_shared<LayoutVehicle>(drawn_vehicle(trial, (number - 1) % trial.vehicles + 1));
      if (!can_swim(vehicle->nominals))
        throw base::Failure(base::Exit::failed,
                            vehicle->layout.name + ": the vehicle cannot swim: lost on a nominal mission");
    }
    cases.push_back(swimming_case(trial, number, vehicle));
    progress(static_cast<double>(cases.size()) / static_cast<double>(numbers.size()));
  }
  return cases;
}

std::string data_sheet(const LayoutVehicle& vehicle) {
  const double error = vehicle.layout_error;
  const std::map<std::string, double> shares{
      {"mass_kg", error / 4},   {"inertia_kg_m2", error},   {"matrix", 2 * error}, {"linear", 2 * error},
      {"quadratic", 2 * error}, {"coefficient", 2 * error}, {"lag_s", 2 * error},  {"force_scale", error}};
  const double arm_m = (vehicle.craft.layout.gravity_centre_m - vehicle.craft.layout.buoyancy_centre_m).norm();
  std::string sheet;
  std::istringstream lines(vehicle.layout.text);
  for (std::string line; std::getline(lines, line);) {
    toml::table one;
    try {
      one = toml::parse(line);
    } catch (const toml::parse_error&) {  // a part of a list over several lines
    }
    const std::string key(one.empty() ? "" : one.begin()->first.str());
    if (key.ends_with("_std") || key.ends_with("_range")) continue;
    sheet += line + '\n';
    if (const auto share = shares.find(key); share != shares.end()) {
      const auto error_of = [&](const toml::node& number) {
        return std::abs(number.value_or(0.0)) * share->second;
      };
      std::vector<double> errors;
      if (const toml::array* list = one[key].as_array())
        std::ranges::transform(*list, std::back_inserter(errors), error_of);
      sheet += errors.empty() ? fmt::format("{}_std = {}\n", key, error_of(*one[key].node()))
                              : fmt::format("{}_std = [{}]\n", key, fmt::join(errors, ", "));
    } else if (key == "gravity_centre_m") {
      sheet += fmt::format("{0}_std = [{1}, {1}, {1}]\n", key, arm_m * error);
    } else if (key == "thruster" && vehicle.layout.text.find("\nforce_scale = ") == std::string::npos) {
      sheet += fmt::format("force_scale = 1\nforce_scale_std = {}\n", error);
    }
  }
  return sheet;
}

}  // namespace navcal::validation

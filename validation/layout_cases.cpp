// SPDX-License-Identifier: Apache-2.0
#include "validation/layout_cases.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "validation/reference/effects.h"
#include "validation/reference/thrusters/outputs.h"

namespace navcal::validation {
namespace {

namespace thrusters = reference::thrusters;
using nlohmann::ordered_json;

// Streams of the dice: vehicles, days and cases draw apart.
constexpr std::uint64_t kVehicleStream = 2ULL << 40U, kDayStream = 3ULL << 40U, kCaseStream = 4ULL << 40U,
                        kTurnStream = 5ULL << 40U, kSwimStream = 6ULL << 40U;
constexpr double kInstrumentTolerance = 0.02;
/// After so many draws of an effect with which a vehicle cannot swim comes the next one.
constexpr int kAttemptsOfAnEffect = 6;

constexpr std::array<std::string_view, kLayoutArms> kLayoutArmNames{"nulls", "single-0.5", "single-1", "single-2",
                                                                    "pairs", "removed",    "foreign"};

// Sixteen to a round.
constexpr std::array kLayoutRound{
    LayoutArm::nulls, LayoutArm::single,  LayoutArm::removed,     LayoutArm::single,
    LayoutArm::nulls, LayoutArm::foreign, LayoutArm::single_half, LayoutArm::single,
    LayoutArm::nulls, LayoutArm::pairs,   LayoutArm::nulls,       LayoutArm::single_double,
    LayoutArm::nulls, LayoutArm::removed, LayoutArm::single,      LayoutArm::foreign};

LayoutArm layout_arm_of(int number) {
  return kLayoutRound[static_cast<std::size_t>(number - 1) % kLayoutRound.size()];
}

/// How many cases of the same arm have lower numbers.
int turn_of(int number) {
  const LayoutArm arm = layout_arm_of(number);
  int turn = 0;
  for (int earlier = 1; earlier < number; ++earlier) turn += layout_arm_of(earlier) == arm ? 1 : 0;
  return turn;
}

double strength_of(LayoutArm arm) {
  if (arm == LayoutArm::single_half) return 0.5;
  return arm == LayoutArm::single_double ? 2 : 1;
}

/// Effects of thrusters and vehicle, or of instruments; of the library, or those outside it; in an order of the
/// seed's, over and over.
const thrusters::CraftEffectKind& effect_in_turn(std::uint64_t seed, LayoutArm arm, bool is_instrument,
                                                 int place) {
  std::vector<const thrusters::CraftEffectKind*> kinds;
  for (const thrusters::CraftEffectKind& kind : thrusters::craft_effects()) {
    if (kind.in_library == (arm != LayoutArm::foreign) &&
        (kind.scope == thrusters::Scope::instrument) == is_instrument)
      kinds.push_back(&kind);
  }
  const std::size_t cycle = static_cast<std::size_t>(place) / kinds.size();
  reference::Rng dice(seed,
                      kTurnStream + 64 * cycle + 2 * static_cast<std::uint64_t>(arm) + (is_instrument ? 1 : 0));
  for (std::size_t i = kinds.size(); i > 1; --i) std::swap(kinds[i - 1], kinds[dice.bits() % i]);
  return *kinds[static_cast<std::size_t>(place) % kinds.size()];
}

/// Two of three single effects are the vehicle's, the third an instrument's; of a pair, one is of each.
std::vector<thrusters::CraftEffect> drawn_effects(std::uint64_t seed, int number, int attempt,
                                                  const thrusters::Plan& layout, reference::Rng& dice) {
  const LayoutArm arm = layout_arm_of(number);
  const int turn = turn_of(number);
  std::vector<thrusters::CraftEffect> effects;
  const auto add = [&](bool is_instrument, int place) {
    const thrusters::CraftEffectKind& kind =
        effect_in_turn(seed, arm, is_instrument, place + attempt / kAttemptsOfAnEffect);
    effects.push_back(thrusters::drawn(kind, strength_of(arm), layout, dice));
  };
  if (arm == LayoutArm::nulls) return effects;
  if (arm == LayoutArm::pairs) {
    add(false, turn);
    add(true, turn);
  } else if (turn % 3 == 2) {
    add(true, turn / 3);
  } else {
    add(false, turn - turn / 3);
  }
  return effects;
}

ordered_json json_of(const thrusters::CraftEffect& effect, const thrusters::Plan& layout) {
  ordered_json json{{"name", effect.name}};
  if (!effect.of.empty()) json["of"] = effect.of;
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
    if (effect.of == "thruster." + std::to_string(i + 1)) json["of_name"] = layout.thrusters[i].name;
  }
  json["parameters"] = effect.parameters;
  return json;
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

}  // namespace

std::string_view name_of(LayoutArm arm) { return kLayoutArmNames[static_cast<std::size_t>(arm)]; }

LayoutArm layout_arm_named(std::string_view name) {
  const auto* const found = std::find(kLayoutArmNames.begin(), kLayoutArmNames.end(), name);
  if (found != kLayoutArmNames.end()) return static_cast<LayoutArm>(found - kLayoutArmNames.begin());
  std::string known;
  for (const std::string_view one : kLayoutArmNames) known.append(known.empty() ? "" : ", ").append(one);
  throw std::invalid_argument("there is no arm " + std::string(name) + "; there are " + known);
}

LayoutVehicleCase drawn_vehicle(std::uint64_t seed, int number, std::span<const NamedLayout> layouts,
                                const LayoutErrors& errors) {
  LayoutVehicleCase vehicle;
  vehicle.number = number;
  vehicle.layout = layouts[static_cast<std::size_t>(number - 1) % layouts.size()];
  thrusters::CraftUnderTest& craft = vehicle.craft;
  try {
    craft.layout = thrusters::plan_of(vehicle.layout.text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(vehicle.layout.name + ": " + error.what());
  }
  if (craft.layout.thrusters.size() > thrusters::kOutputChannels)
    throw std::invalid_argument(vehicle.layout.name + ": more than eight thrusters cannot be reported");
  reference::Rng dice(seed, kVehicleStream + static_cast<std::uint64_t>(number));
  craft.real = thrusters::perturbed(craft.layout, errors.layout, dice);
  craft.nature.resistance = dice.uniform(0.2, 0.4);
  craft.nature.overshoot = errors.unmodelled * dice.uniform(0.05, 0.2);
  craft.nature.jet_loss = std::min(errors.unmodelled * dice.uniform(0, 0.04), 1.0);
  craft.nature.strips = std::min(errors.unmodelled * dice.uniform(0, 0.1), 1.0);
  craft.nature.current_m_s *= errors.unmodelled;
  craft.nature.wave_m *= errors.unmodelled;
  craft.doppler = {dice.normal(0.003), dice.normal(1e-4)};
  reference::apply_tolerance(kInstrumentTolerance, craft.differences.instruments, dice);
  constexpr double kGreatestClockError = 0.01;
  craft.compass_clock = dice.uniform(-kGreatestClockError, kGreatestClockError);
  craft.card_clock = dice.uniform(-kGreatestClockError, kGreatestClockError);
  vehicle.place = drawn_place(seed, number);
  return vehicle;
}

thrusters::CraftUnderTest nominal_day(std::uint64_t seed, const LayoutVehicleCase& vehicle, int day) {
  reference::Rng dice(
      seed, kDayStream + (static_cast<std::uint64_t>(vehicle.number) << 20U) + static_cast<std::uint64_t>(day));
  thrusters::CraftUnderTest craft = vehicle.craft;
  craft.real = thrusters::perturbed(craft.real, kDayTolerance, dice);
  return craft;
}

LayoutCase drawn_layout_case(std::uint64_t seed, int number, const LayoutVehicleCase& vehicle, int attempt) {
  reference::Rng dice(
      seed, kCaseStream + (static_cast<std::uint64_t>(number) << 8U) + static_cast<std::uint64_t>(attempt));
  LayoutCase drawn;
  drawn.number = number;
  drawn.vehicle = vehicle.number;
  drawn.arm = layout_arm_of(number);
  drawn.craft = vehicle.craft;
  drawn.craft.real = thrusters::perturbed(drawn.craft.real, kDayTolerance, dice);
  drawn.effects = drawn_effects(seed, number, attempt, vehicle.craft.layout, dice);
  for (const thrusters::CraftEffect& effect : drawn.effects)
    thrusters::add(effect, vehicle.craft.layout, drawn.craft.differences);
  if (drawn.arm == LayoutArm::removed) drawn.excluded = drawn.effects.front().name;
  return drawn;
}

thrusters::Swim drawn_swim(const LayoutVehicleCase& vehicle, std::uint64_t mission_seed, double duration_s,
                           int day) {
  reference::Rng dice(mission_seed, kSwimStream);
  thrusters::Swim swim;
  swim.start_ns = vehicle.place.begin_ns + day * kDay_ns;
  swim.duration_s = duration_s;
  swim.legs = thrusters::drawn_legs(vehicle.craft.layout, duration_s, dice);
  swim.start.position_m.z() = swim.legs.front().depth_m;
  swim.start.world_from_body = reference::attitude(0, 0, dice.uniform(0, 2 * std::numbers::pi));
  swim.anchorage = vehicle.place.anchorage;
  swim.waters = vehicle.place.waters;
  swim.waters.density_kg_m3 = vehicle.craft.layout.density_kg_m3;
  return swim;
}

std::string full_name(const thrusters::CraftEffect& effect) {
  return effect.of.empty() ? effect.name : effect.name + " of " + effect.of;
}

std::string truth_text(const LayoutVehicleCase& vehicle, std::uint64_t seed, const LayoutErrors& errors) {
  const auto& [anchorage, waters, begin_ns] = vehicle.place;
  const thrusters::Nature& nature = vehicle.craft.nature;
  const ordered_json truth{{"vehicle", vehicle.number},
                           {"seed", seed},
                           {"layout", vehicle.layout.name},
                           {"layout_error", errors.layout},
                           {"unmodelled", errors.unmodelled},
                           {"day_tolerance", kDayTolerance},
                           {"place",
                            {{"latitude_deg", anchorage.latitude_deg},
                             {"longitude_deg", anchorage.longitude_deg},
                             {"begin_ns", begin_ns},
                             {"field_uT", numbers_of(waters.field_uT)},
                             {"water_C", waters.surface_C}}},
                           {"real", json_of(vehicle.craft.real, vehicle.craft.layout)},
                           {"nature",
                            {{"resistance", nature.resistance},
                             {"overshoot", nature.overshoot},
                             {"jet_loss", nature.jet_loss},
                             {"strips", nature.strips},
                             {"current_m_s", nature.current_m_s},
                             {"wave_m", nature.wave_m},
                             {"doppler_scale", vehicle.craft.doppler.scale},
                             {"compass_clock", vehicle.craft.compass_clock},
                             {"card_clock", vehicle.craft.card_clock}}}};
  return truth.dump();
}

std::string truth_text(const LayoutCase& drawn, std::uint64_t seed) {
  ordered_json effects = ordered_json::array();
  for (const thrusters::CraftEffect& effect : drawn.effects)
    effects.push_back(json_of(effect, drawn.craft.layout));
  const ordered_json truth{{"case", drawn.number},       {"seed", seed},
                           {"vehicle", drawn.vehicle},   {"arm", name_of(drawn.arm)},
                           {"excluded", drawn.excluded}, {"effects", effects}};
  return truth.dump();
}

}  // namespace navcal::validation

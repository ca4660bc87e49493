// SPDX-License-Identifier: Apache-2.0
#include "validation/cases.h"

#include <sys/random.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <numeric>
#include <system_error>
#include <utility>

#include "record/content_hash.h"
#include "validation/confounded_effects.h"
#include "validation/layout_cases.h"

namespace navcal::validation {
namespace {

std::string fresh_salt() {
  std::array<unsigned char, 32> bytes{};
  // So few bytes come whole, or not at all (getrandom(2)).
  while (::getrandom(bytes.data(), bytes.size(), 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::system_category(), "getrandom");
  }
  return record::hexadecimal(bytes);
}

constexpr double kTolerance = 0.02, kLooseTolerance = 0.06;
/// Orders of drawing lie apart from the cases themselves.
constexpr std::uint64_t kOrderStream = 1ULL << 32U;

using Kinds = std::vector<const reference::EffectKind*>;

Kinds chosen_kinds(std::uint64_t seed, TrialArm arm, int place, reference::Rng& dice) {
  const auto library = reference::library_effects();
  const auto turn_at = [&](int at, std::size_t count) {
    return in_turn(seed, kOrderStream + static_cast<std::uint64_t>(arm), 4096, at, count);
  };
  const auto turn = [&](std::size_t count) { return turn_at(place, count); };
  const auto add_any = [&](Kinds& kinds) {
    const reference::EffectKind* kind = nullptr;
    do kind = &library[dice.bits() % library.size()];
    while (std::ranges::find(kinds, kind) != kinds.end());
    kinds.push_back(kind);
  };
  Kinds kinds;
  switch (arm) {
    case TrialArm::nulls:
    case TrialArm::nulls_6: break;
    case TrialArm::foreign:
      kinds.push_back(&reference::foreign_effects()[turn(reference::foreign_effects().size())]);
      break;
    case TrialArm::pairs:
      if (place % 2 == 1) {
        const auto pairs = confounded_pairs();
        const ConfoundedEffects& pair = pairs[turn_at(place / 2, pairs.size())];
        kinds = {reference::find_effect(pair.first), reference::find_effect(pair.second)};
        break;
      }
      kinds.push_back(&library[turn_at(place / 2, library.size())]);
      add_any(kinds);
      break;
    case TrialArm::triples:
      kinds.push_back(&library[turn(library.size())]);
      add_any(kinds);
      add_any(kinds);
      break;
    default: kinds.push_back(&library[turn(library.size())]);
  }
  return kinds;
}

/// Clocks of cards without a crystal: off by up to a hundredth.
reference::VehicleUnderTest::Clocks drawn_clocks(reference::Rng& dice) {
  constexpr double kGreatest = 0.01;
  reference::VehicleUnderTest::Clocks clocks;
  for (double* const clock : {&clocks.compass, &clocks.card, &clocks.motor})
    *clock = dice.uniform(-kGreatest, kGreatest);
  return clocks;
}

nlohmann::ordered_json json_of(const TrialPlace& place) {
  const auto& field_uT = place.waters.field_uT;
  return {{"latitude_deg", place.anchorage.latitude_deg},
          {"longitude_deg", place.anchorage.longitude_deg},
          {"begin_ns", place.begin_ns},
          {"field_uT", {field_uT.x(), field_uT.y(), field_uT.z()}},
          {"water_C", place.waters.surface_C},
          {"density_kg_m3", place.waters.density_kg_m3}};
}

/// The parameters that the vehicle has of an effect.
TrialParameters real_parameters(const reference::EffectKind& kind, const reference::VehicleUnderTest& vehicle) {
  reference::ParameterDeviations deviations = vehicle.deviations;
  const double* const field = kind.field(deviations);
  TrialParameters real;
  for (std::size_t i = 0; i < kind.parameters.size(); ++i)
    real.emplace(kind.parameters[i], field[i] / kind.size.si);
  return real;
}

nlohmann::ordered_json json_of(const TrialEffect& effect, const TrialParameters& parameters) {
  nlohmann::ordered_json json{{"name", effect.name}};
  if (!effect.of.empty()) json["of"] = effect.of;
  if (!effect.of_name.empty()) json["of_name"] = effect.of_name;
  json["parameters"] = parameters;
  return json;
}

}  // namespace

Commitment commitment_to(std::string truth) {
  Commitment seal{std::move(truth), fresh_salt(), {}};
  seal.digest = record::sha256_of(seal.truth + seal.salt);
  return seal;
}

std::size_t in_turn(std::uint64_t seed, std::uint64_t stream, std::uint64_t stride, int place, std::size_t count) {
  reference::Rng dice(seed, stream + stride * (static_cast<std::size_t>(place) / count));
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[dice.bits() % i]);
  return order[static_cast<std::size_t>(place) % count];
}

bool TrialCase::in_library() const { return arm != TrialArm::foreign && arm != TrialArm::removed; }

TrialCase drawn_case(std::uint64_t seed, int number, double minutes, int places) {
  TrialCase drawn;
  drawn.number = number;
  drawn.arm = arm_of_case(number);
  const TrialArmFacts& facts = facts_of(drawn.arm);
  drawn.minutes = facts.missions == MissionKind::brief ? kBriefMinutes : minutes;

  reference::Rng dice(seed, static_cast<std::uint64_t>(number));
  for (std::uint64_t& mission_seed : drawn.mission_seeds) mission_seed = dice.bits();
  const double tolerance = drawn.arm == TrialArm::nulls_6 ? kLooseTolerance : kTolerance;
  reference::apply_tolerance(tolerance, drawn.vehicle.deviations, dice);
  for (const reference::EffectKind* kind : chosen_kinds(seed, drawn.arm, ordinal_in_arm(number), dice)) {
    const reference::Effect effect = reference::drawn(*kind, facts.strength, dice);
    drawn.effects.push_back({effect.name, effect.parameters});
    reference::add(effect, drawn.vehicle.deviations);
  }
  for (TrialEffect& effect : drawn.effects)
    effect.real = real_parameters(*reference::find_effect(effect.name), drawn.vehicle);
  drawn.vehicle.clocks = drawn_clocks(dice);
  drawn.place_number = static_cast<int>(dice.bits() % static_cast<std::uint64_t>(places));
  drawn.place = drawn_place(seed, drawn.place_number);
  if (drawn.arm == TrialArm::removed) drawn.excluded = drawn.effects.front().name;
  return drawn;
}

std::string truth_text(const TrialCase& drawn, std::uint64_t seed) {
  auto effects = nlohmann::ordered_json::array(), real = nlohmann::ordered_json::array();
  for (const TrialEffect& effect : drawn.effects) {
    effects.push_back(json_of(effect, effect.drawn));
    real.push_back(json_of(effect, effect.real));
  }
  nlohmann::ordered_json truth{{"case", drawn.number},
                               {"seed", seed},
                               {"arm", facts_of(drawn.arm).name},
                               {"minutes", drawn.minutes},
                               {"excluded", drawn.excluded},
                               {"drawn", effects},
                               {"with_tolerance", real},
                               {"place", json_of(drawn.place)}};
  if (drawn.on_layout != nullptr) {
    truth["vehicle"] = nlohmann::ordered_json::parse(drawn.on_layout->vehicle->truth);
  } else {
    const auto& clocks = drawn.vehicle.clocks;
    truth["clocks"] = {{"compass", clocks.compass}, {"card", clocks.card}, {"motor", clocks.motor}};
  }
  truth["mission_seeds"] = drawn.mission_seeds;
  return truth.dump();
}

}  // namespace navcal::validation

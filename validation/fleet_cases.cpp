// SPDX-License-Identifier: Apache-2.0
#include "validation/fleet_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace navcal::validation {
namespace {

constexpr double kOwnTolerance = 0.02;
/// Apart from the cases of the other trials.
constexpr std::uint64_t kFleetStream = 11ULL << 40U;
/// Effects of the water, or of the Earth's field at the place: a day has one of them, and a vehicle none of the
/// last two.
constexpr std::array<std::string_view, 3> kOfDay{"buoyancy", "declination", "water_current"};

bool is_of_day(std::string_view name) { return std::find(kOfDay.begin(), kOfDay.end(), name) != kOfDay.end(); }

/// Draws effects for vehicles and the design, none twice before all came once.
class EffectDeck {
 public:
  explicit EffectDeck(reference::Rng& dice) : dice_(dice) {}

  const reference::EffectKind& next() {
    if (left_.empty()) {
      for (const reference::EffectKind& kind : reference::library_effects()) {
        if (!is_of_day(kind.name)) left_.push_back(&kind);
      }
    }
    const std::size_t at = dice_.bits() % left_.size();
    const reference::EffectKind* const kind = left_[at];
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
    return *kind;
  }

 private:
  reference::Rng& dice_;
  std::vector<const reference::EffectKind*> left_;
};

/// The first `count` numbers from 1 to `of` in a random order.
std::vector<int> some_of(int count, int of, reference::Rng& dice) {
  std::vector<int> all;
  for (int i = 1; i <= of; ++i) all.push_back(i);
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[dice.bits() % i]);
  all.resize(static_cast<std::size_t>(std::clamp(count, 0, of)));
  return all;
}

void draw_causes_of_vehicles(FleetCase& fleet, EffectDeck& deck, reference::Rng& dice) {
  const FleetTrialOptions& options = fleet.options;
  const int tenth = std::max(1, options.vehicles / 10);
  const std::vector<int> chosen = some_of(6 * tenth, options.vehicles, dice);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const bool begins = static_cast<int>(i) >= 3 * tenth && static_cast<int>(i) < 5 * tenth;
    const bool is_foreign = static_cast<int>(i) >= 5 * tenth;
    const auto foreign = reference::foreign_effects();
    const reference::EffectKind& kind = is_foreign ? foreign[dice.bits() % foreign.size()] : deck.next();
    const double strength = is_foreign ? 1 : options.strength;
    int from = 1;
    if (begins && options.days > 3)
      from = 3 + static_cast<int>(dice.bits() % static_cast<std::uint64_t>(options.days - 3));
    fleet.causes.push_back(
        {FleetLevel::vehicle, chosen[i], from, strength, is_foreign, reference::drawn(kind, strength, dice)});
  }
}

void draw_causes_of_days(FleetCase& fleet, reference::Rng& dice) {
  for (const int day : some_of(3 * std::max(1, fleet.options.days / 10), fleet.options.days, dice)) {
    const reference::EffectKind& kind = *reference::find_effect(kOfDay[dice.bits() % kOfDay.size()]);
    const double strength = std::max(fleet.options.strength, 0.5);
    fleet.causes.push_back({FleetLevel::day, 0, day, strength, false, reference::drawn(kind, strength, dice)});
  }
}

nlohmann::ordered_json json_of(const FleetCause& cause) {
  return {{"level", name_of(cause.level)},        {"vehicle", cause.vehicle},    {"day", cause.day},
          {"strength", cause.strength},           {"foreign", cause.is_foreign}, {"name", cause.effect.name},
          {"parameters", cause.effect.parameters}};
}

}  // namespace

std::string_view name_of(FleetLevel level) {
  switch (level) {
    case FleetLevel::vehicle: return "vehicle";
    case FleetLevel::design: return "design";
    case FleetLevel::day: return "day";
  }
  return "";
}

bool FleetCause::acts_in(int of_vehicle, int on_day) const {
  switch (level) {
    case FleetLevel::vehicle: return of_vehicle == vehicle && on_day >= day;
    case FleetLevel::design: return true;
    case FleetLevel::day: return on_day == day;
  }
  return false;
}

FleetCase drawn_fleet(const FleetTrialOptions& options) {
  FleetCase fleet;
  fleet.options = options;
  fleet.place = drawn_place(options.seed, 0);
  reference::Rng dice(options.seed, kFleetStream);
  for (int v = 0; v < options.vehicles; ++v) {
    reference::VehicleUnderTest vehicle;
    reference::apply_tolerance(kOwnTolerance, vehicle.deviations, dice);
    fleet.vehicles.push_back(vehicle);
  }
  EffectDeck deck(dice);
  for (const double strength : {options.strength, options.weak}) {
    if (strength > 0) {
      fleet.causes.push_back(
          {FleetLevel::design, 0, 0, strength, false, reference::drawn(deck.next(), strength, dice)});
    }
  }
  draw_causes_of_vehicles(fleet, deck, dice);
  draw_causes_of_days(fleet, dice);
  return fleet;
}

reference::VehicleUnderTest vehicle_on(const FleetCase& fleet, int vehicle, int day) {
  reference::VehicleUnderTest made = fleet.vehicles[static_cast<std::size_t>(vehicle - 1)];
  for (const FleetCause& cause : fleet.causes) {
    if (cause.acts_in(vehicle, day)) reference::add(cause.effect, made.deviations);
  }
  return made;
}

std::string vehicle_name(int vehicle) { return fmt::format("v{:02}", vehicle); }

std::string mission_name(int vehicle, int day) {
  return fmt::format("{}/day-{:02}.cap", vehicle_name(vehicle), day);
}

std::string truth_text(const FleetCase& fleet) {
  nlohmann::ordered_json json{{"seed", fleet.options.seed},
                              {"vehicles", fleet.options.vehicles},
                              {"days", fleet.options.days},
                              {"minutes", fleet.options.minutes},
                              {"begin_ns", fleet.place.begin_ns}};
  json["causes"] = nlohmann::ordered_json::array();
  for (const FleetCause& cause : fleet.causes) json["causes"].push_back(json_of(cause));
  return json.dump(2) + "\n";
}

FleetTruth read_fleet_truth(std::string_view text) {
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    FleetTruth truth{json.at("vehicles"), json.at("days"), json.at("begin_ns"), {}};
    for (const auto& each : json.at("causes")) {
      FleetCause cause;
      const std::string level = each.at("level");
      cause.level = level == "vehicle"  ? FleetLevel::vehicle
                    : level == "design" ? FleetLevel::design
                                        : FleetLevel::day;
      cause.vehicle = each.at("vehicle");
      cause.day = each.at("day");
      cause.strength = each.at("strength");
      cause.is_foreign = each.at("foreign");
      cause.effect.name = each.at("name");
      cause.effect.parameters = each.at("parameters");
      truth.causes.push_back(std::move(cause));
    }
    return truth;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("no truth of a fleet: ") + error.what());
  }
}

}  // namespace navcal::validation

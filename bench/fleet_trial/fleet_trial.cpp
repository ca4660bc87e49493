// SPDX-License-Identifier: Apache-2.0
#include "bench/fleet_trial/fleet_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/enum_name.h"
#include "base/parallel.h"
#include "base/utc_text.h"
#include "validation/recordings.h"

namespace navcal::bench {
using validation::kDay_ns;
using validation::MissionKind;
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

using FleetAnswerJson = nlohmann::json;

/// Sailed by each vehicle in turn, and by the vehicles of one day alike.
reference::Mission mission_of(const FleetCase& fleet, int day) {
  const MissionKind kind =
      fleet.options.minutes == validation::kBriefMinutes ? MissionKind::brief : MissionKind::usual;
  reference::Mission mission = validation::at_place(
      validation::trial_missions(kind, fleet.options.minutes)[static_cast<std::size_t>(day) % 3], fleet.place);
  mission.start_ns = fleet.place.begin_ns + day * kDay_ns;
  return mission;
}

std::string date_of_day(const FleetTruth& truth, int day) {
  return base::utc_date_text(truth.begin_ns + day * kDay_ns);
}

bool is_of(const FleetAnswerJson& named, const FleetCause& cause, const FleetTruth& truth) {
  if (named.at("level") != name_of(cause.level)) return false;
  const std::string of = named.at("of");
  switch (cause.level) {
    case FleetLevel::vehicle: return of == vehicle_name(cause.vehicle);
    case FleetLevel::design: return true;
    case FleetLevel::day: return of.starts_with(date_of_day(truth, cause.day));
  }
  return false;
}

/// Number of the day in the name of a recording, "day-03.cap".
int day_in(const std::string& recording) {
  const auto at = recording.find("day-");
  if (at == std::string::npos) throw std::runtime_error("the recording " + recording + " is none of this trial");
  return std::stoi(recording.substr(at + 4));
}

std::string group_of(const FleetCause& cause, double strongest_design) {
  if (cause.level == FleetLevel::vehicle) return cause.day > 1 ? "vehicle, begins" : "vehicle";
  if (cause.level == FleetLevel::day) return "day";
  return cause.strength < strongest_design ? "design, weak" : "design";
}

class Scoring {
 public:
  Scoring(const FleetTruth& truth, const FleetAnswerJson& answer) : truth_(truth), answer_(answer) {
    for (const FleetCause& cause : truth.causes) {
      if (cause.level == FleetLevel::design) strongest_design_ = std::max(strongest_design_, cause.strength);
    }
  }

  FleetScore run() {
    for (const FleetCause& cause : truth_.causes) {
      if (!cause.is_foreign) judge(cause);
    }
    for (const FleetAnswerJson& named : answer_.at("causes")) {
      ++score_.named;
      const bool is_there = std::any_of(truth_.causes.begin(), truth_.causes.end(), [&](const FleetCause& cause) {
        return named.at("name") == cause.effect.name && is_of(named, cause, truth_);
      });
      if (!is_there) ++score_.named_wrong;
    }
    for (const FleetAnswerJson& vehicle : answer_.at("vehicles")) {
      const bool is_foreign =
          std::any_of(truth_.causes.begin(), truth_.causes.end(), [&](const FleetCause& cause) {
            return cause.is_foreign && vehicle_name(cause.vehicle) == vehicle.at("vehicle").get<std::string>();
          });
      ++(is_foreign ? score_.foreign : score_.sound);
      if (vehicle.at("verdict") == "unknown") ++(is_foreign ? score_.foreign_unknown : score_.sound_unknown);
    }
    return score_;
  }

 private:
  void judge(const FleetCause& cause) {
    std::string outcome = "missed";
    for (const FleetAnswerJson& named : answer_.at("causes")) {
      if (named.at("name") != cause.effect.name) continue;
      if (is_of(named, cause, truth_)) {
        outcome = "right";
        judge_details(cause, named);
        break;
      }
      if (cause.level != FleetLevel::vehicle || named.at("level") == "design") outcome = "wrong level";
    }
    for (const FleetAnswerJson& open : answer_.at("undecided")) {
      const auto is_it = [&](const FleetAnswerJson& one) {
        return one.at("name") == cause.effect.name && is_of(one, cause, truth_);
      };
      const auto& others = open.at("alternatives");
      if (outcome == "missed" && (is_it(open) || std::any_of(others.begin(), others.end(), is_it)))
        outcome = "undecided";
    }
    ++score_.causes[group_of(cause, strongest_design_)][outcome];
  }

  void judge_details(const FleetCause& cause, const FleetAnswerJson& named) {
    if (cause.level == FleetLevel::vehicle && cause.day > 1) {
      ++score_.begun;
      const auto& since = named.at("since");
      if (!since.is_null() && std::abs(day_in(since.at("recording")) - cause.day) <= 1) ++score_.begun_right;
    }
    for (const auto& [key, value] : named.at("parameters").items()) {
      const auto truth = cause.effect.parameters.find(key);
      const double error = value.get<double>() - (truth == cause.effect.parameters.end() ? 0 : truth->second);
      ++score_.parameters;
      if (std::abs(error) <= 2 * named.at("std_errors").at(key).get<double>()) ++score_.parameters_within_two;
    }
  }

  const FleetTruth& truth_;
  const FleetAnswerJson& answer_;
  double strongest_design_ = 0;
  FleetScore score_;
};

}  // namespace

std::string_view name_of(FleetLevel level) {
  return base::enum_name<FleetLevel::day>(level, {"vehicle", "design", "day"});
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
  fleet.place = validation::drawn_place(options.seed, 0);
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
      cause.level = base::enum_named<FleetLevel::day>(each.at("level").get<std::string>(), [](auto level) {
                      return name_of(level);
                    }).value_or(FleetLevel::day);
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

void write_fleet(const FleetCase& fleet, const std::filesystem::path& folder, unsigned threads,
                 const std::function<void(double)>& progress) {
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder)) {
    throw std::invalid_argument(folder.string() + ": the folder is not empty");
  }
  std::filesystem::create_directories(folder);
  validation::write_vehicle_file(fleet.place, folder);
  struct Mission {
    int vehicle = 0, day = 0;
    std::uint64_t seed = 0;
  };
  constexpr std::uint64_t kSeedStream = 12ULL << 40U;
  reference::Rng dice(fleet.options.seed, kSeedStream);
  std::vector<Mission> missions;
  for (int vehicle = 1; vehicle <= fleet.options.vehicles; ++vehicle) {
    std::filesystem::create_directories(folder / vehicle_name(vehicle));
    for (int day = 1; day <= fleet.options.days; ++day) missions.push_back({vehicle, day, dice.bits()});
  }
  std::mutex mutex;
  std::size_t done = 0;
  base::in_parallel(threads, missions.size(), [&](std::size_t i) {
    const auto& [vehicle, day, seed] = missions[i];
    validation::write_recording(mission_of(fleet, day), vehicle_on(fleet, vehicle, day), seed,
                                folder / mission_name(vehicle, day));
    const std::lock_guard lock(mutex);
    progress(static_cast<double>(++done) / static_cast<double>(missions.size()));
  });
}

FleetScore score_of(const FleetTruth& truth, std::string_view answer_json) {
  try {
    const FleetAnswerJson answer = FleetAnswerJson::parse(answer_json);
    return Scoring(truth, answer).run();
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("no answer of navcal fleet causes: ") + error.what());
  }
}

std::string score_text(const FleetScore& score) {
  const auto share = [](int count, int of) {
    return fmt::format("{} of {}{}", count, of, of > 0 ? fmt::format(" ({:.0f} %)", 100.0 * count / of) : "");
  };
  std::string text = fmt::format("{:<18}{:>8}{:>14}{:>12}{:>8}\n", "sealed causes", "right", "wrong level",
                                 "undecided", "missed");
  for (const auto& [group, outcomes] : score.causes) {
    const auto count = [&outcomes = outcomes](const char* outcome) {
      const auto found = outcomes.find(outcome);
      return found == outcomes.end() ? 0 : found->second;
    };
    text += fmt::format("{:<18}{:>8}{:>14}{:>12}{:>8}\n", group, count("right"), count("wrong level"),
                        count("undecided"), count("missed"));
  }
  text += fmt::format("onset within one mission: {}\n", share(score.begun_right, score.begun));
  text += fmt::format("named and not there: {}\n", share(score.named_wrong, score.named));
  text += fmt::format("vehicles with an effect outside the library, unknown: {}\n",
                      share(score.foreign_unknown, score.foreign));
  text += fmt::format("other vehicles, unknown: {}\n", share(score.sound_unknown, score.sound));
  text += fmt::format("parameters within two standard errors: {}\n",
                      share(score.parameters_within_two, score.parameters));
  return text;
}

}  // namespace navcal::bench

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/enum_name.h"
#include "fleet/causes/limits.h"
#include "fleet/causes/pooled_evidence.h"

// The prior of a cause is shared out in steps: each level alike, each unit of the level alike, each effect that
// the level can have alike. Half of a vehicle's share is for effects that act in all of its missions. The other
// half is for those that begin, end, or both, in the course of them, each pair of times alike.
namespace navcal::fleet {
namespace {

constexpr double kLevels = 3;

bool is_never_of_vehicle(const EffectColumns& effect) {
  return std::find(kNeverOfVehicle.begin(), kNeverOfVehicle.end(), effect.name) != kNeverOfVehicle.end();
}

/// Effects of one vehicle, for all of its missions and for each stretch of them.
void add_vehicle(const MissionGroup& vehicle, std::size_t effect, double log_prior,
                 std::vector<PossibleCause>& causes) {
  const std::size_t n = vehicle.missions.size();
  const double half = n > 1 ? std::log(0.5) : 0;
  causes.push_back({effect, CauseLevel::vehicle, vehicle.name, vehicle.missions, {}, {}, log_prior + half});
  if (n < 2) return;
  const double stretches = static_cast<double>(n) * static_cast<double>(n + 1) / 2 - 1;
  for (std::size_t from = 0; from < n; ++from) {
    for (std::size_t to = from; to < n; ++to) {
      if (from == 0 && to == n - 1) continue;
      PossibleCause cause{effect, CauseLevel::vehicle, vehicle.name, {}, {}, {}, 0};
      cause.missions.assign(vehicle.missions.begin() + static_cast<std::ptrdiff_t>(from),
                            vehicle.missions.begin() + static_cast<std::ptrdiff_t>(to) + 1);
      if (from > 0) cause.since = from;
      if (to < n - 1) cause.until = to;
      cause.log_prior = log_prior + half - std::log(stretches);
      causes.push_back(std::move(cause));
    }
  }
}

}  // namespace

std::string_view name_of(CauseLevel level) {
  return base::enum_name<CauseLevel::day>(level, {"vehicle", "design", "day"});
}

std::vector<PossibleCause> possible_causes(const PooledMissions& missions) {
  const auto& effects = missions.effects();
  const auto share = [&](std::size_t units, double of_effects) {
    return -std::log(kLevels * static_cast<double>(units) * of_effects) - kCauseCost_nats;
  };
  const auto all = static_cast<double>(effects.size());
  const double of_vehicle = all - static_cast<double>(kNeverOfVehicle.size());
  std::vector<PossibleCause> causes;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    if (!is_never_of_vehicle(effects[e])) {
      for (const MissionGroup& vehicle : missions.vehicles()) {
        add_vehicle(vehicle, e, share(missions.vehicles().size(), of_vehicle), causes);
      }
    }
    for (const MissionGroup& design : missions.designs()) {
      const bool is_shared = std::any_of(design.missions.begin(), design.missions.end(), [&](std::size_t m) {
        return missions.vehicle_of(m) != missions.vehicle_of(design.missions.front());
      });
      if (!is_shared) continue;  // nothing tells the design from its only vehicle
      causes.push_back(
          {e, CauseLevel::design, design.name, design.missions, {}, {}, share(missions.designs().size(), all)});
    }
    if (!effects[e].is_of_surroundings) continue;
    for (const MissionGroup& day : missions.days()) {
      causes.push_back({e,
                        CauseLevel::day,
                        day.name,
                        day.missions,
                        {},
                        {},
                        share(missions.days().size(), static_cast<double>(kOfSurroundings.size()))});
    }
  }
  return causes;
}

}  // namespace navcal::fleet

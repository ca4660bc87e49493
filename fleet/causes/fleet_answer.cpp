// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/fleet_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <utility>

#include "base/enum_name.h"
#include "fleet/causes/limits.h"

namespace navcal::fleet {
namespace {

constexpr std::string_view kBacklash = "fin_backlash";

std::vector<FleetMission> without(const PooledMissions& missions, const std::vector<std::string>& vehicles) {
  std::vector<FleetMission> rest = missions.missions();
  std::erase_if(rest, [&](const FleetMission& mission) {
    return std::find(vehicles.begin(), vehicles.end(), mission.vehicle) != vehicles.end();
  });
  return rest;
}

bool is_same_mission(const FleetMission& a, const FleetMission& b) {
  return a.recording == b.recording && a.vehicle == b.vehicle && a.utc_ns == b.utc_ns;
}

/// Changes indices into `pool` to those of the same missions in `all`, which has them in the same order.
void renumber(PossibleCause& cause, const PooledMissions& pool, const PooledMissions& all) {
  std::size_t at = 0;
  for (std::size_t& m : cause.missions) {
    while (!is_same_mission(all.missions()[at], pool.missions()[m])) ++at;
    m = at;
  }
}

/// Every second mission of each vehicle, beginning with the first or the second.
PooledMissions half_of(const PooledMissions& missions, std::size_t begin) {
  std::vector<FleetMission> half;
  for (const MissionGroup& vehicle : missions.vehicles()) {
    for (std::size_t i = begin; i < vehicle.missions.size(); i += 2) {
      half.push_back(missions.missions()[vehicle.missions[i]]);
    }
  }
  return PooledMissions(std::move(half));
}

/// The missions of `half` among those that the cause acts in.
std::vector<std::size_t> within(const PooledMissions& half, const PooledMissions& missions,
                                const PossibleCause& cause) {
  std::vector<std::size_t> found;
  for (std::size_t m = 0; m < half.missions().size(); ++m) {
    const FleetMission& mission = half.missions()[m];
    const bool acts = std::any_of(cause.missions.begin(), cause.missions.end(),
                                  [&](std::size_t i) { return is_same_mission(missions.missions()[i], mission); });
    if (acts) found.push_back(m);
  }
  return found;
}

/// Parameters of the causes as one half of the missions has them. A cause that does not act in that half is zero.
std::vector<Eigen::VectorXd> fitted_to(const PooledMissions& half, const PooledMissions& missions,
                                       const std::vector<FoundCause>& causes) {
  std::vector<ActingCause> acting;
  std::vector<std::size_t> place;
  std::vector<Eigen::VectorXd> values;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    values.push_back(Eigen::VectorXd::Zero(causes[i].mean.size()));
    ActingCause one = causes[i].acting;
    one.cause.missions = within(half, missions, one.cause);
    if (one.cause.missions.empty()) continue;
    acting.push_back(std::move(one));
    place.push_back(i);
  }
  const PooledEvidence evidence(half, acting);
  for (std::size_t i = 0; i < place.size(); ++i) values[place[i]] = evidence.mean_of(i);
  return values;
}

/// Parameters of one mission with the causes that act in it, typical values.
Eigen::VectorXd values_in(std::size_t mission, const PooledMissions& missions,
                          const std::vector<FoundCause>& causes, const std::vector<Eigen::VectorXd>& values) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(missions.size());
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const PossibleCause& cause = causes[i].acting.cause;
    if (!std::binary_search(cause.missions.begin(), cause.missions.end(), mission)) continue;
    all.segment(missions.effects()[cause.effect].first, values[i].size()) += values[i];
  }
  return all;
}

/// Whether a cause may imitate the backlash `other`, which acts in some of its missions.
bool imitates(const FoundCause& cause, const FoundCause& backlash) {
  const PossibleCause &mine = cause.acting.cause, &theirs = backlash.acting.cause;
  const bool is_own = mine.level == theirs.level && mine.of == theirs.of;
  if (strength_of(cause) >= (is_own ? kBesideOwnBacklash : kBesideBacklash) * strength_of(backlash)) return false;
  return std::find_first_of(mine.missions.begin(), mine.missions.end(), theirs.missions.begin(),
                            theirs.missions.end()) != mine.missions.end();
}

/// For each cause, whether it may imitate the backlash of another one.
std::vector<bool> imitating(const PooledMissions& missions, const std::vector<FoundCause>& causes) {
  const auto is_backlash = [&](const FoundCause& cause) {
    return missions.effects()[cause.acting.cause.effect].name == kBacklash;
  };
  std::vector<bool> imitate;
  for (const FoundCause& cause : causes) {
    imitate.push_back(!is_backlash(cause) && std::ranges::any_of(causes, [&](const FoundCause& other) {
      return is_backlash(other) && imitates(cause, other);
    }));
  }
  return imitate;
}

/// Gaps of all missions, the causes fitted to those of `pool`.
std::vector<MissionGap> gaps_of(const PooledMissions& missions, const PooledMissions& pool,
                                const std::vector<FoundCause>& causes) {
  const bool has_halves = std::any_of(pool.vehicles().begin(), pool.vehicles().end(),
                                      [](const MissionGroup& vehicle) { return vehicle.missions.size() > 1; });
  std::array<std::vector<Eigen::VectorXd>, 2> fitted;
  for (std::size_t half = 0; half < 2; ++half) {
    fitted[half] = fitted_to(has_halves ? half_of(pool, half) : pool, missions, causes);
  }
  std::vector<MissionGap> gaps(missions.missions().size());
  for (const MissionGroup& vehicle : missions.vehicles()) {
    for (std::size_t i = 0; i < vehicle.missions.size(); ++i) {
      const std::size_t m = vehicle.missions[i];
      const gap::RecordingInformation& of = missions.missions()[m].information;
      const Eigen::VectorXd values = values_in(m, missions, causes, fitted[(i + 1) % 2]);
      const double after = of.power - 2 * of.score.dot(values) + values.dot(of.information * values);
      gaps[m] = {of.power / of.measurements, after / of.measurements, of.null_power, of.null_power_std};
    }
  }
  return gaps;
}

double closed(const MissionGap& gap) { return 1 - (gap.after - gap.floor) / (gap.before - gap.floor); }

/// Mean of some missions of one vehicle. The floor scatters with the tolerances of the vehicle, which all of its
/// missions share, so the scatter does not fall with their number.
MissionGap mean_of(const std::vector<MissionGap>& gaps, const std::vector<std::size_t>& missions) {
  MissionGap mean;
  const auto n = static_cast<double>(missions.size());
  for (const std::size_t m : missions) {
    mean.before += gaps[m].before / n;
    mean.after += gaps[m].after / n;
    mean.floor += gaps[m].floor / n;
    mean.floor_std += gaps[m].floor_std / n;
  }
  return mean;
}

/// 95 % interval of the closure by a bootstrap of the missions, each floor with its error.
std::array<double, 2> closure_interval(const std::vector<MissionGap>& gaps,
                                       const std::vector<std::size_t>& missions) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::size_t> draw(0, missions.size() - 1);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (int i = 0; i < kFleetResamples; ++i) {
    std::vector<std::size_t> resampled(missions.size());
    for (std::size_t& m : resampled) m = missions[draw(random)];
    MissionGap gap = mean_of(gaps, resampled);
    gap.floor += gap.floor_std * normal(random);
    values.push_back(closed(gap));
  }
  std::sort(values.begin(), values.end());
  return {values[values.size() / 40], values[values.size() - 1 - values.size() / 40]};
}

bool acts_in(const FoundCause& cause, const MissionGroup& vehicle) {
  return std::any_of(vehicle.missions.begin(), vehicle.missions.end(), [&](std::size_t m) {
    return std::binary_search(cause.acting.cause.missions.begin(), cause.acting.cause.missions.end(), m);
  });
}

VehicleAnswer answer_of_vehicle(const MissionGroup& vehicle, const FleetAnswer& fleet) {
  VehicleAnswer answer;
  answer.vehicle = vehicle.name;
  const bool is_outlier =
      std::find(fleet.outliers.begin(), fleet.outliers.end(), vehicle.name) != fleet.outliers.end();
  answer.gap = mean_of(fleet.missions, vehicle.missions);
  const auto is_clear = [&](double power) {
    return power > answer.gap.floor + kFleetGap_sigma * answer.gap.floor_std;
  };
  const auto acts = [&](const FoundCause& cause) { return acts_in(cause, vehicle); };
  const bool has_cause = std::any_of(fleet.causes.begin(), fleet.causes.end(), acts);
  const bool is_undecided = std::any_of(
      fleet.undecided.begin(), fleet.undecided.end(),
      [&](const FoundCause& cause) { return cause.acting.cause.level == CauseLevel::vehicle && acts(cause); });
  if (is_clear(answer.gap.before)) {
    answer.closed = closed(answer.gap);
    answer.closed_ci = closure_interval(fleet.missions, vehicle.missions);
  }
  if (is_outlier) {
    answer.verdict = FleetVerdict::unknown;
    answer.reason = fmt::format("more than {} causes would be needed: what acts in it is not in the library",
                                kMostCausesPerVehicle);
  } else if (is_clear(answer.gap.after) && answer.closed_ci && (*answer.closed_ci)[1] < kFleetClosedFrom) {
    answer.verdict = FleetVerdict::unknown;
    answer.reason = fmt::format("what was found closes {:.0f} % of the gap (95 % interval up to {:.0f} %)",
                                100 * *answer.closed, 100 * (*answer.closed_ci)[1]);
  } else if (is_undecided) {
    answer.verdict = FleetVerdict::unknown;
    answer.reason = "something acts in its missions, and what or whose it is, is not decided";
  } else if (has_cause) {
    answer.verdict = FleetVerdict::explained;
  }
  return answer;
}

/// What was found in a vehicle whose gap stays unknown may imitate what is not in the library, so it is not named.
void withdraw_from_unknown(FleetAnswer& answer) {
  const auto is_unknown = [&](const FoundCause& cause) {
    return cause.acting.cause.level == CauseLevel::vehicle &&
           std::any_of(answer.vehicles.begin(), answer.vehicles.end(), [&](const VehicleAnswer& vehicle) {
             return vehicle.vehicle == cause.acting.cause.of && vehicle.verdict == FleetVerdict::unknown;
           });
  };
  const auto kept = std::stable_partition(answer.causes.begin(), answer.causes.end(),
                                          [&](const FoundCause& cause) { return !is_unknown(cause); });
  answer.undecided.insert(answer.undecided.end(), std::make_move_iterator(kept),
                          std::make_move_iterator(answer.causes.end()));
  answer.causes.erase(kept, answer.causes.end());
}

}  // namespace

std::string_view name_of(FleetVerdict verdict) {
  return base::enum_name<FleetVerdict::unknown>(verdict, {"no-gap", "explained", "unknown"});
}

double strength_of(const FoundCause& cause) {
  return std::sqrt(std::max(0.0, cause.mean.squaredNorm() - cause.std.squaredNorm()));
}

double tolerance_of(CauseLevel level) {
  switch (level) {
    case CauseLevel::vehicle: return kToleranceDeviations * kVehicleTolerance;
    case CauseLevel::design: return kToleranceDeviations * kDesignTolerance;
    case CauseLevel::day: return kToleranceDeviations * kDayTolerance;
  }
  return 0;
}

FleetAnswer answer_of_fleet(const PooledMissions& missions, unsigned threads, const CauseProgress& progress) {
  FleetAnswer answer;
  CauseSearchResult result = find_causes(missions, threads, progress);
  while (!result.outlier.empty()) {
    answer.outliers.push_back(result.outlier);
    const std::vector<FleetMission> rest = without(missions, answer.outliers);
    if (rest.empty()) break;
    const PooledMissions pool(rest);
    result = find_causes(pool, threads, progress);
    for (FoundCause& cause : result.causes) {
      renumber(cause.acting.cause, pool, missions);
      for (Alternative& other : cause.alternatives) renumber(other.cause, pool, missions);
    }
  }
  // What is left is what nothing that was found closes, whether its name is certain or not.
  const std::vector<FleetMission> pooled = without(missions, answer.outliers);
  answer.missions = gaps_of(missions, pooled.empty() ? missions : PooledMissions(pooled), result.causes);
  const std::vector<bool> imitate = imitating(missions, result.causes);
  for (std::size_t i = 0; i < result.causes.size(); ++i) {
    FoundCause& cause = result.causes[i];
    const bool is_tolerance = strength_of(cause) <= tolerance_of(cause.acting.cause.level);
    const bool is_named = cause.probability >= kCauseNamedFrom && !imitate[i];
    (is_tolerance ? answer.tolerances : is_named ? answer.causes : answer.undecided).push_back(std::move(cause));
  }
  for (const MissionGroup& vehicle : missions.vehicles()) {
    answer.vehicles.push_back(answer_of_vehicle(vehicle, answer));
  }
  withdraw_from_unknown(answer);
  return answer;
}

}  // namespace navcal::fleet

// SPDX-License-Identifier: Apache-2.0
#include "gap/design/design_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "config/mission_file.h"
#include "gap/design/coverage.h"
#include "gap/inference/linearised.h"
#include "gap/thresholds.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"
#include "sim/vehicle/vehicle.h"

namespace navcal::gap {
namespace {

constexpr std::uint64_t kDesignSeed = 1;
constexpr int kMostExchanges = 4;
/// Steady time at the beginning of a planned mission, s: the estimator settles.
constexpr double kStart_s = 6;
/// Share by which a planned mission may exceed a limit on rates and angles: an autopilot overshoots.
constexpr double kOvershoot = 1.25;
/// Weight of what a separation adds beyond what decides, so that equal choices are ordered.
constexpr double kBeyond = 1e-3;

/// Duration of the steps of a mission that holds its last course at the end, s; at most `most_s`.
double duration_of(const config::Mission& steps, const config::VehicleSettings& vehicle, double most_s) {
  constexpr std::int64_t kBegin_ns = 0;
  const sim::SimulatedMotion motion(vehicle, std::make_unique<sim::MissionHelm>(vehicle, steps),
                                    sim::MotionOptions{kBegin_ns, nullptr, 20});
  return std::min(motion.duration_s(), most_s);
}

}  // namespace

namespace {

/// Each effect of a test against none: only the model without effects is needed.
void set_tested(const DesignGoal& goal, const Eigen::MatrixXd& total, SeparationTable& table) {
  const ModelForecast none_so_far({}, goal.information, goal.library, goal.priors);
  const ModelForecast none_after({}, total, goal.library, goal.priors);
  for (Eigen::Index a = 1; a < table.added.rows(); ++a) {
    const Eigen::VectorXd& values = goal.hypotheses[static_cast<std::size_t>(a)].values;
    table.so_far(a, 0) = none_so_far.unexplained_nats(values);
    table.added(a, 0) = std::max(0.0, none_after.unexplained_nats(values) - table.so_far(a, 0));
  }
}

}  // namespace

SeparationTable separations(const DesignGoal& goal, const Eigen::MatrixXd& planned_information) {
  const auto n = static_cast<Eigen::Index>(goal.hypotheses.size());
  const Eigen::MatrixXd total = goal.information + planned_information;
  SeparationTable table{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  if (goal.purpose == DesignPurpose::test) {
    set_tested(goal, total, table);
    return table;
  }
  std::vector<ModelForecast> so_far, after;
  for (const Hypothesis& each : goal.hypotheses) {
    so_far.emplace_back(each.effects, goal.information, goal.library, goal.priors);
    after.emplace_back(each.effects, total, goal.library, goal.priors);
  }
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b < n; ++b) {
      if (a == b) continue;
      const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b);
      const Eigen::VectorXd& values = goal.hypotheses[i].values;
      table.so_far(a, b) = so_far[i].expected_over(so_far[k], values);
      table.added(a, b) = std::max(0.0, after[i].expected_over(after[k], values) - table.so_far(a, b));
    }
  }
  return table;
}

DesignSearch::DesignSearch(const DiagnosisProblem& problem, const DesignGoal& goal,
                           const config::MissionLimits& limits)
    : problem_(problem), goal_(goal), limits_(limits) {}

DesignedMission DesignSearch::run() {
  simulate_alphabet();
  DesignedMission designed;
  // A mission as a whole can leave the area although each manoeuvre stays in it: the longest one then goes.
  for (std::size_t attempt = 0; attempt < alphabet_.size(); ++attempt) {
    Chosen chosen = chosen_greedily();
    exchange(chosen);
    designed = simulated(chosen);
    if (chosen.size() < 2 || is_within_limits(designed.planned.track, true)) break;
    const auto longest = std::max_element(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) {
      return alphabet_[a].seconds < alphabet_[b].seconds;
    });
    alphabet_.erase(alphabet_.begin() + static_cast<std::ptrdiff_t>(*longest));
  }
  return designed;
}

void DesignSearch::simulate_alphabet() {
  std::vector<ManoeuvreChoice> choices = manoeuvre_alphabet(limits_);
  std::vector<std::optional<Simulated>> all(choices.size());
  const Mission& recorded = problem_.prepared.mission;
  const Waters waters{problem_.request.vehicle, recorded.instruments, recorded.field};
  std::size_t done = 0;
  problem_.progress("simulating manoeuvres", 0);
  base::in_parallel(problem_.threads, choices.size(), [&](std::size_t i) {
    const config::Mission steps =
        config::parse_mission(mission_file_of({&choices[i]}, limits_, "one manoeuvre"), "plan");
    try {
      const double seconds = duration_of(steps, problem_.request.vehicle, limits_.duration_s);
      PlannedMission planned = planned_mission(steps, seconds, waters, kDesignSeed);
      leave_out(problem_.request.without, planned.mission);
      if (!is_within_limits(planned.track, false)) return;
      all[i] =
          Simulated{choices[i], gram_of(planned, 1), seconds - kStart_s, regimes_sailed(planned.track, limits_)};
    } catch (const sim::UnstableVehicle&) {
      return;  // the vehicle cannot sail it
    }
  });
  done = choices.size();
  problem_.progress("simulating manoeuvres", static_cast<double>(done) / static_cast<double>(choices.size()));
  for (auto& one : all) {
    if (one) alphabet_.push_back(std::move(*one));
  }
}

Eigen::MatrixXd DesignSearch::gram_of(const PlannedMission& planned, unsigned threads) const {
  const Replay replay(planned.mission, problem_.request.vehicle);
  const Eigen::VectorXd at = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem_.library.unknowns().size()));
  return linearise({replay, problem_.library, problem_.prepared.bank.whitening, threads}, at).gram;
}

double DesignSearch::utility(const Chosen& chosen) const {
  const auto n = static_cast<Eigen::Index>(problem_.library.unknowns().size());
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
  std::set<std::string> regimes;
  for (const std::size_t i : chosen) {
    gram += alphabet_[i].gram;
    regimes.insert(alphabet_[i].regimes.begin(), alphabet_[i].regimes.end());
  }
  const SeparationTable table = separations(goal_, information_without_biases(gram, goal_.priors));
  double shown = 0;
  for (Eigen::Index a = 0; a < table.added.rows(); ++a) {
    for (Eigen::Index b = 0; b < table.added.cols(); ++b) {
      const double weight = std::sqrt(goal_.hypotheses[static_cast<std::size_t>(a)].probability *
                                      goal_.hypotheses[static_cast<std::size_t>(b)].probability);
      // What the recordings show already counts no more in a test.
      const double before = goal_.purpose == DesignPurpose::test ? table.so_far(a, b) : 0;
      const double after = before + table.added(a, b);
      shown +=
          weight * ((std::min(after, kObservable_nats) - std::min(before, kObservable_nats)) / kObservable_nats +
                    kBeyond * std::log1p(table.added(a, b)));
    }
  }
  switch (goal_.purpose) {
    case DesignPurpose::separate:
      return probability_of_exact_answer(goal_.hypotheses, table.added) + 0.05 * shown;
    case DesignPurpose::cover: {
      std::size_t fresh = 0;
      for (const std::string& regime : regimes) fresh += goal_.sailed.contains(regime) ? 0U : 1U;
      return static_cast<double>(fresh) + 0.1 * static_cast<double>(regimes.size()) + 0.05 * shown;
    }
    case DesignPurpose::test:
      return shown;
  }
  return 0;
}

double DesignSearch::seconds_of(const Chosen& chosen) const {
  double seconds = kStart_s;
  for (const std::size_t i : chosen) seconds += alphabet_[i].seconds;
  return seconds;
}

DesignSearch::Chosen DesignSearch::chosen_greedily() const {
  Chosen chosen;
  double now = utility(chosen);
  while (true) {
    std::vector<double> gains(alphabet_.size(), -1);
    base::in_parallel(problem_.threads, alphabet_.size(), [&](std::size_t i) {
      Chosen with = chosen;
      with.push_back(i);
      if (seconds_of(with) <= limits_.duration_s) gains[i] = (utility(with) - now) / alphabet_[i].seconds;
    });
    const auto best = std::max_element(gains.begin(), gains.end());
    if (best == gains.end() || *best < 0) return chosen;
    chosen.push_back(static_cast<std::size_t>(best - gains.begin()));
    now = utility(chosen);
  }
}

void DesignSearch::exchange(Chosen& chosen) const {
  for (int round = 0; round < kMostExchanges; ++round) {
    problem_.progress("choosing manoeuvres", static_cast<double>(round) / kMostExchanges);
    const double before = utility(chosen);
    for (std::size_t& place : chosen) {
      const std::size_t own = place;
      std::vector<double> values(alphabet_.size(), -std::numeric_limits<double>::infinity());
      base::in_parallel(problem_.threads, alphabet_.size(), [&](std::size_t i) {
        Chosen other = chosen;
        other[static_cast<std::size_t>(&place - chosen.data())] = i;
        if (seconds_of(other) <= limits_.duration_s) values[i] = utility(other);
      });
      const auto best = std::max_element(values.begin(), values.end());
      const bool is_better = *best > values[own] + 1e-9;
      place = is_better ? static_cast<std::size_t>(best - values.begin()) : own;
    }
    if (utility(chosen) <= before + 1e-9) return;
  }
}

DesignedMission DesignSearch::simulated(const Chosen& chosen) const {
  std::vector<const ManoeuvreChoice*> choices;
  DesignedMission designed;
  double from_s = kStart_s;
  for (const std::size_t i : chosen) {
    choices.push_back(&alphabet_[i].choice);
    designed.manoeuvres.push_back({alphabet_[i].choice.name, from_s});
    from_s += alphabet_[i].seconds;
  }
  designed.toml = mission_file_of(choices, limits_, "What decides next, planned by navcal gap next");
  const config::Mission steps = config::parse_mission(designed.toml, "plan");
  designed.duration_s = duration_of(steps, problem_.request.vehicle, limits_.duration_s);
  const Mission& recorded = problem_.prepared.mission;
  designed.planned = planned_mission(
      steps, designed.duration_s, {problem_.request.vehicle, recorded.instruments, recorded.field}, kDesignSeed);
  leave_out(problem_.request.without, designed.planned.mission);
  designed.information = information_without_biases(gram_of(designed.planned, problem_.threads), goal_.priors);
  return designed;
}

bool DesignSearch::is_within_limits(const std::vector<PlannedInstant>& track, bool is_whole) const {
  double energy_J = 0;
  for (const PlannedInstant& now : track) {
    energy_J += now.motor_current_A * limits_.battery_V;
    if (std::hypot(now.north_m, now.east_m) > limits_.radius_m) return false;
    if (now.depth_m > limits_.greatest_depth_m ||
        std::abs(now.pitch_rad) > kOvershoot * limits_.greatest_pitch_rad ||
        std::abs(now.turn_rate_rad_s) > kOvershoot * limits_.greatest_turn_rate_rad_s) {
      return false;
    }
  }
  return !is_whole || !limits_.energy_J || energy_J <= *limits_.energy_J;
}

}  // namespace navcal::gap

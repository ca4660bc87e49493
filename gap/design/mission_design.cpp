// SPDX-License-Identifier: Apache-2.0
#include "gap/design/mission_design.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/parallel.h"
#include "config/mission_file.h"
#include "gap/design/coverage.h"
#include "gap/design/design_search.h"
#include "gap/design/hypotheses.h"
#include "gap/design/manoeuvres.h"
#include "gap/thresholds.h"
#include "gap/verdict/diagnose_further.h"
#include "sim/vehicle/vehicle.h"

namespace navcal::gap {
namespace {

/// Strength of the weak effects that a mission is tested for where no gap is seen, typical values.
constexpr double kWeakStrength = 0.2;
/// Probability from which a set of effects needs no further separation.
constexpr double kDecided = 0.95;
/// Gain in the probability of an exact answer from which a mission is said to decide.
constexpr double kDecides = 0.05;

std::vector<std::string> names_of(const EffectSubset& set, const Library& library) {
  std::vector<std::string> names;
  for (const std::size_t effect : set) names.emplace_back(library[effect].name);
  return names;
}

std::string text_of(const std::vector<std::string>& set) {
  return set.empty() ? "no effect" : fmt::format("{}", fmt::join(set, " and "));
}

/// Designs one mission after a diagnosis.
class MissionDesign {
 public:
  MissionDesign(const DiagnosisProblem& problem, const FoundEffects& found, const config::MissionLimits& limits,
                NextMission& next)
      : problem_(problem), found_(found), limits_(limits), next_(next) {}

  void run() {
    const auto began = std::chrono::steady_clock::now();
    set_purpose();
    const DesignGoal goal{next_.purpose,    hypotheses_,   information_so_far(),
                          problem_.library, found_.priors, regimes_so_far()};
    DesignSearch search(problem_, goal, limits_);
    const DesignedMission designed = search.run();
    take(designed, goal);
    say(goal);
    next_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  }

 private:
  void set_purpose() {
    hypotheses_ = probable_hypotheses(problem_, found_);
    const Hypothesis& leader = hypotheses_.front();
    const bool shows_nothing = leader.effects.empty() && leader.probability > kDecided;
    next_.purpose = next_.diagnosis.verdict == Verdict::unknown ? DesignPurpose::cover
                    : shows_nothing                             ? DesignPurpose::test
                                                                : DesignPurpose::separate;
    if (next_.purpose == DesignPurpose::test) {
      hypotheses_ = weak_hypotheses(problem_.library, found_.priors, kWeakStrength);
    }
  }

  /// Sum of the information of all recordings.
  [[nodiscard]] Eigen::MatrixXd information_so_far() const {
    return information_without_biases(found_.found.best.linear.gram, found_.priors);
  }

  [[nodiscard]] std::set<std::string> regimes_so_far() const {
    std::set<std::string> all = regimes_sailed(problem_.prepared.course, limits_);
    for (const Prepared* other : problem_.others) all.merge(regimes_sailed(other->course, limits_));
    return all;
  }

  void take(const DesignedMission& designed, const DesignGoal& goal) {
    next_.toml = designed.toml;
    next_.track = designed.planned.track;
    next_.duration_s = designed.duration_s;
    next_.manoeuvres = designed.manoeuvres;
    for (const PlannedInstant& now : next_.track) next_.energy_J += now.motor_current_A * limits_.battery_V;
    const SeparationTable table = separations(goal, designed.information);
    if (next_.purpose == DesignPurpose::test) {
      shown_so_far_ = (table.so_far.col(0).array() >= kObservable_nats).count();
      shown_after_ = ((table.so_far + table.added).col(0).array() >= kObservable_nats).count();
    }
    next_.probability_exact = probability_of_exact_answer(hypotheses_, table.added);
    next_.probability_so_far =
        probability_of_exact_answer(hypotheses_, Eigen::MatrixXd::Zero(table.added.rows(), table.added.cols()));
    next_.decides = next_.probability_exact > next_.probability_so_far + kDecides;
    for (std::size_t a = 0; a < hypotheses_.size(); ++a) {
      for (std::size_t b = a + 1; b < hypotheses_.size(); ++b) {
        if (next_.purpose == DesignPurpose::test && a > 0) continue;  // each effect against none
        const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
        const double nats = next_.purpose == DesignPurpose::test ? table.added(j, i)
                                                                 : std::min(table.added(i, j), table.added(j, i));
        next_.pairs.push_back({names_of(hypotheses_[a].effects, problem_.library),
                               names_of(hypotheses_[b].effects, problem_.library), nats,
                               hypotheses_[a].log_odds - hypotheses_[b].log_odds});
      }
    }
    std::stable_sort(next_.pairs.begin(), next_.pairs.end(), [](const SeparatedPair& x, const SeparatedPair& y) {
      return x.separation_nats < y.separation_nats;
    });
    for (const std::string& regime : regimes_sailed(next_.track, limits_)) {
      if (!goal.sailed.contains(regime)) next_.covers.push_back(regime);
    }
  }

  void say(const DesignGoal& goal) {
    const double minutes = next_.duration_s / 60;
    switch (next_.purpose) {
      case DesignPurpose::separate:
        next_.sentence = separation_sentence(minutes);
        return;
      case DesignPurpose::cover:
        next_.sentence =
            fmt::format("The cause may not be in the library. This mission of {:.1f} minutes {}.", minutes,
                        next_.covers.empty()
                            ? "repeats what was sailed, because the recordings cover all that the limits allow"
                            : fmt::format("sails what the recordings did not: {}", fmt::join(next_.covers, ", ")));
        return;
      case DesignPurpose::test: {
        next_.sentence = fmt::format(
            "The recordings show no gap. With this mission of {:.1f} minutes they would show {} of {} effects at "
            "{} of "
            "their typical strength; so far it is {}.",
            minutes, shown_after_, goal.hypotheses.size() - 1, kWeakStrength, shown_so_far_);
        return;
      }
    }
  }

  [[nodiscard]] std::string separation_sentence(double minutes) const {
    if (next_.pairs.empty()) return "One set of effects is all that is probable: nothing is left to decide.";
    const SeparatedPair& least = next_.pairs.front();
    if (next_.decides) {
      return fmt::format(
          "This mission of {:.1f} minutes is expected to tell {} from {} by {:.1f} nats or more; an exact answer "
          "then has "
          "a probability of {:.2f} instead of {:.2f}.",
          minutes, text_of(least.a), text_of(least.b), least.separation_nats, next_.probability_exact,
          next_.probability_so_far);
    }
    if (next_.probability_so_far > 1 - kDecides) {
      return fmt::format("The recordings decide already: an exact answer has a probability of {:.2f}.",
                         next_.probability_so_far);
    }
    return fmt::format(
        "No mission of {:.1f} minutes within these limits is expected to decide: the best found adds {:.1f} nats "
        "between {} "
        "and {}, and an exact answer then has a probability of {:.2f}.",
        minutes, least.separation_nats, text_of(least.a), text_of(least.b), next_.probability_exact);
  }

  const DiagnosisProblem& problem_;
  const FoundEffects& found_;
  const config::MissionLimits& limits_;
  NextMission& next_;
  std::vector<Hypothesis> hypotheses_;
  Eigen::Index shown_so_far_ = 0, shown_after_ = 0;  ///< effects of a test with kObservable_nats or more
};

}  // namespace

std::string_view name_of(DesignPurpose purpose) {
  switch (purpose) {
    case DesignPurpose::separate:
      return "separate";
    case DesignPurpose::cover:
      return "cover";
    case DesignPurpose::test:
      return "test";
  }
  return "";
}

NextMission next_mission(const Request& request, const config::MissionLimits& limits, const Progress& progress) {
  NextMission next;
  Diagnosis diagnosis = diagnose_further(
      request, progress, [&](const DiagnosisProblem& problem, const FoundEffects& found, const Diagnosis& answer) {
        next.diagnosis.verdict = answer.verdict;
        MissionDesign(problem, found, limits, next).run();
      });
  next.diagnosis = std::move(diagnosis);
  if (next.toml.empty()) next.sentence = next.diagnosis.sentence;
  return next;
}

}  // namespace navcal::gap

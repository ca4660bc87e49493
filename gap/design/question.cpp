// SPDX-License-Identifier: Apache-2.0
#include "gap/design/question.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/angles.h"
#include "base/parallel.h"
#include "gap/inference/subset_evidence.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

constexpr double kScale_s = 5, kSeen_s = 2;

/// A quantity in bands of equal width; values beyond belong to the outermost bands.
struct Bands {
  std::string_view name, unit;
  double first, width;
  int count;

  [[nodiscard]] int index(double value) const {
    return std::clamp(static_cast<int>(std::floor((value - first) / width)), 0, count - 1);
  }
  [[nodiscard]] std::string words(int i) const {
    const double from = first + i * width;
    return fmt::format("{} {:g} to {:g} {}", name, from, from + width, unit);
  }
};

enum Quantity7 : std::size_t { shaft, turn, deep, pitch, roll, head, since };
constexpr std::array<Bands, 7> kBands{{{"shaft speed", "rpm", 0, 150, 9},
                                       {"rate of turn", "deg/s", -52.5, 15, 7},
                                       {"depth", "m", 0, 1, 12},
                                       {"pitch", "deg", -35, 10, 7},
                                       {"roll", "deg", -15, 6, 5},
                                       {"heading", "deg", 0, 45, 8},
                                       {"time since the start", "s", 0, 120, 10}}};

Eigen::Index offset_of(std::size_t quantity) {
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < quantity; ++i) at += kBands[i].count;
  return at;
}

Eigen::Index joint_offset() { return offset_of(kBands.size()); }

void add(const std::array<double, 7>& values, Coverage& seconds) {
  for (std::size_t i = 0; i < kBands.size(); ++i)
    seconds[offset_of(i) + kBands[i].index(values[i])] += kInterval_s;
  const std::ptrdiff_t row = kBands[shaft].index(values[shaft]), column = kBands[turn].index(values[turn]);
  seconds[joint_offset() + row * kBands[turn].count + column] += kInterval_s;
}

double heading_deg(double rad) {
  const double deg = std::fmod(rad * base::kDegreesPerRadian, 360);
  return deg < 0 ? deg + 360 : deg;
}

/// Most sets that a plan tells apart, and the probability from which a set counts.
constexpr std::size_t kMostSets = 6;
constexpr double kCountedFrom = 0.002;
/// Probability of a set that must be considered although the recordings cannot show it.
constexpr double kUnseenProbability = 0.05;
/// Probability of no effect from which nothing is left to separate.
constexpr double kNothingFrom = 0.95;
/// Strength beyond which a further improvement counts no more, and that of an effect which is not shown.
constexpr double kSharpEnough = 0.05, kNotShown = 10;
/// Weight of coverage beside the error bound while sets are to be separated: it decides between equals only.
constexpr double kLittleCoverage = 1e-3;
/// Weight of the error bound beside coverage where a foreign cause is suspected, and the bound (some 40 nats
/// between all pairs) beyond which it counts no more.
constexpr double kSomeSeparation = 0.1, kApartLog = -10;

Eigen::LLT<Eigen::MatrixXd> bias_factor_of(const Eigen::MatrixXd& gram) {
  Eigen::MatrixXd own = gram.topLeftCorner<Library::kBiases, Library::kBiases>();
  own.diagonal().array() += 1 / (kTurnOnBiasPrior_rad_s * kTurnOnBiasPrior_rad_s);
  return own.llt();
}

/// Gram matrix with the biases of the gyros projected out: each recording has its own.
Eigen::MatrixXd without_biases(const Eigen::MatrixXd& gram) {
  return gram - gram.leftCols<Library::kBiases>() * bias_factor_of(gram).solve(gram.topRows<Library::kBiases>());
}

Information information_of(const Study& study) {
  const Linearised& linear = study.found->found.best.linear;
  Information all{linear.gram, linear.score + linear.gram * linear.at};
  const unsigned threads = base::threads_or_cores(study.request.threads);
  for (const auto& other : study.holdouts) {
    const Linearised further = linearise(other->model(study.library, threads), other->at);
    all.gram += without_biases(further.gram);
    const Eigen::VectorXd score = further.score + further.gram * further.at;
    all.score += score - further.gram.leftCols<Library::kBiases>() *
                             bias_factor_of(further.gram).solve(score.head<Library::kBiases>());
  }
  return all;
}

/// Priors with the usual tolerance for effects that the search took as nuisance parameters: another mission may
/// show them.
Priors priors_of(const Study& study) {
  Priors priors = study.found->priors;
  for (const EffectSubset* hidden : {&study.found->unobservable, &study.found->not_judged()}) {
    for (const Eigen::Index j : parameter_indices(study.library, *hidden)) {
      priors.slab[j] = study.library.unknowns()[static_cast<std::size_t>(j)].typical;
      priors.spike[j] = std::max(kTolerance * priors.slab[j], priors.model_error[j]);
    }
  }
  return priors;
}

/// The sets that are still probable, and those of effects that the recordings could not show.
std::vector<WeighedSet> sets_of(const Study& study) {
  std::vector<WeighedSet> sets;
  for (const Candidate& candidate : study.found->found.candidates)
    sets.push_back({candidate.effects, candidate.probability});
  for (const std::size_t hidden : study.found->unobservable) sets.push_back({{hidden}, kUnseenProbability});
  return weighed(sets, kCountedFrom);
}

MissionPurpose purpose_of(const Study& study) {
  if (study.diagnosis.verdict == Verdict::no_gap) {
    // An effect may be probable, and too small to be named.
    const Candidate& leader = study.found->found.candidates.front();
    const bool shows_nothing = leader.effects.empty() && leader.probability > kNothingFrom;
    return shows_nothing ? MissionPurpose::sharpen : MissionPurpose::separate;
  }
  if (study.diagnosis.verdict == Verdict::explained) return MissionPurpose::separate;
  const auto& found = study.found->found;
  double leading = 0, rivals = 0;
  for (const Candidate& candidate : found.candidates) {
    if (candidate.effects == found.best.effects) {
      leading = candidate.probability;
    } else if (!candidate.effects.empty()) {
      rivals += candidate.probability;
    }
  }
  const bool is_clear = leading >= kNamedFrom && rivals <= kMostRivals;
  // An effect that the recordings hardly show is no sign of a foreign cause: a mission that shows it is wanted.
  const bool is_shown = unobservable_effects(found).empty();
  return is_clear && is_shown ? MissionPurpose::cover : MissionPurpose::separate;
}

}  // namespace

Coverage no_coverage() {
  return Coverage::Zero(joint_offset() + Eigen::Index{kBands[shaft].count} * kBands[turn].count);
}

Coverage coverage_of(const Trajectory10Hz& course) {
  Coverage seconds = no_coverage();
  for (std::size_t i = 0; i < course.time_s.size(); ++i) {
    add({course.shaft_rps[i] * 60, course.yaw_rate_rad_s[i] * base::kDegreesPerRadian, course.depth_m[i],
         course.pitch_rad[i] * base::kDegreesPerRadian, course.roll_rad[i] * base::kDegreesPerRadian,
         heading_deg(course.heading_rad[i]), course.time_s[i]},
        seconds);
  }
  return seconds;
}

Coverage coverage_of(const PlannedPath& path, double from_s, double until_s) {
  Coverage seconds = no_coverage();
  for (std::size_t i = 0; i < path.time_s.size(); ++i) {
    if (path.time_s[i] < from_s || path.time_s[i] >= until_s) continue;
    add({path.shaft_rps[i] * 60, path.turn_rad_s[i] * base::kDegreesPerRadian, path.depth_m[i],
         path.pitch_rad[i] * base::kDegreesPerRadian, path.roll_rad[i] * base::kDegreesPerRadian,
         heading_deg(path.heading_rad[i]), path.time_s[i]},
        seconds);
  }
  return seconds;
}

double coverage_loss(const Coverage& seconds) { return (-seconds.array() / kScale_s).exp().sum(); }

std::vector<std::string> newly_covered(const Coverage& before, const Coverage& after) {
  std::vector<std::string> words;
  for (std::size_t quantity = 0; quantity < kBands.size(); ++quantity) {
    for (int i = 0; i < kBands[quantity].count; ++i) {
      const Eigen::Index at = offset_of(quantity) + i;
      if (before[at] < kSeen_s && after[at] >= kSeen_s) words.push_back(kBands[quantity].words(i));
    }
  }
  return words;
}

double Question::loss(const Contribution& planned) const {
  switch (purpose) {
    case MissionPurpose::separate:
      return log_error_bound(hypotheses, told_by(planned.gram)) +
             kLittleCoverage * coverage_loss(so_far.coverage + planned.coverage);
    case MissionPurpose::cover:
      return coverage_loss(so_far.coverage + planned.coverage) +
             kSomeSeparation * std::max(kApartLog, log_error_bound(hypotheses, told_by(planned.gram)));
    case MissionPurpose::sharpen: break;
  }
  const Eigen::VectorXd strengths = smallest_strengths(planned.gram);
  return strengths.cwiseMax(kSharpEnough).cwiseMin(kNotShown).array().log().sum();
}

Eigen::VectorXd Question::smallest_strengths(const Eigen::MatrixXd& planned) const {
  return gap::smallest_strengths(so_far.gram + adds(planned), tested, tolerances, kObservable_nats);
}

void ask_about(const Library& library, const Priors& priors, Question& question) {
  for (std::size_t effect = 0; effect < library.size(); ++effect) {
    question.names.emplace_back(library[effect].name);
    if (!library.holds(effect)) continue;
    for (const Eigen::Index j : parameter_indices(library, {effect})) {
      const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
      question.tested.push_back({effect, std::string(unknown.name), j, unknown.typical});
    }
  }
  question.tolerances = priors.spike;
  question.unknowns = std::ssize(library.unknowns());
  question.adds = without_biases;
}

Eigen::VectorXd curved_estimates(const Question& question, const Library& library) {
  Eigen::VectorXd at = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  // The most probable set that has an effect comes first.
  for (const Hypothesis& set : question.hypotheses) {
    for (const std::size_t effect : set.effects) {
      if (!library.is_curved(effect)) continue;
      for (const Eigen::Index j : parameter_indices(library, {effect})) {
        if (at[j] == 0) at[j] = set.mean[j];
      }
    }
  }
  return at;
}

std::vector<WeighedSet> weighed(std::span<const WeighedSet> sets, double counted_from) {
  std::vector<WeighedSet> counted;
  for (const WeighedSet& set : sets) {
    const bool there = std::ranges::any_of(counted, [&](const auto& one) { return one.effects == set.effects; });
    if (!there && set.probability >= counted_from && counted.size() < kMostSets) counted.push_back(set);
  }
  const auto is_none = [](const WeighedSet& set) { return set.effects.empty(); };
  if (std::ranges::none_of(counted, is_none)) counted.push_back({{}, 1e-6});
  double total = 0;
  for (const WeighedSet& set : counted) total += set.probability;
  for (WeighedSet& set : counted) set.probability /= total;
  return counted;
}

Question question_of(const Study& study) {
  const Library& library = study.library;
  const Information so_far = information_of(study);
  const Priors priors = priors_of(study);
  Question question;
  question.purpose = purpose_of(study);
  ask_about(library, priors, question);
  question.so_far = {so_far.gram, coverage_of(study.prepared->course)};
  for (const auto* others : {&study.together, &study.holdouts})
    for (const auto& other : *others) question.so_far.coverage += coverage_of(other->course);
  for (const WeighedSet& set : sets_of(study))
    question.hypotheses.push_back(make_hypothesis(set.effects, set.probability, so_far, library, priors));
  return question;
}

}  // namespace navcal::gap

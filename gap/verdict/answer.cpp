// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/answer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>
#include <set>

#include "gap/inference/subset_evidence.h"
#include "gap/replay/regimes.h"
#include "gap/thresholds.h"

namespace navcal::gap {

std::string tie_breaker(const sim::EffectDescription& one, const sim::EffectDescription& other) {
  const std::string_view first = one.manoeuvre.text(), second = other.manoeuvre.text();
  if (first == second) return std::string(first);
  return std::string(first) + "; and " + std::string(second);
}

namespace {

std::vector<Confusion> confusions(std::size_t effect, const SearchResult& found, const Library& library,
                                  const Evidence& evidence) {
  std::vector<Confusion> all;
  const auto members = parameter_indices(library, {effect});
  const double alone = evidence.separation(members, found.best.mean, {});
  for (std::size_t other = 0; other < library.size(); ++other) {
    const auto& set = found.best.effects;
    if (other == effect || !library.holds(other) || std::ranges::find(set, other) != set.end()) continue;
    const double left = evidence.separation(members, found.best.mean, parameter_indices(library, {other}));
    if (left < kObservable_nats && left < kConfusedBelow * alone) {
      all.push_back({std::string(library[other].name), tie_breaker(library[effect], library[other]), left});
    }
  }
  std::ranges::sort(all, {}, &Confusion::separation_nats);
  return all;
}

std::vector<EffectParameterEstimate> parameters(std::size_t effect, const ModelFit& fit, const Library& library) {
  std::vector<EffectParameterEstimate> all;
  for (const Eigen::Index j : parameter_indices(library, {effect})) {
    all.push_back({std::string(library.unknowns()[static_cast<std::size_t>(j)].name), fit.mean[j], fit.std[j]});
  }
  return all;
}

double rms(const Eigen::MatrixXd& values) {
  return values.size() > 0 ? std::sqrt(values.squaredNorm() / static_cast<double>(values.rows())) : 0;
}

/// Closure of one channel; empty where the channel was not measured.
std::optional<ChannelClosure> closure_of(std::size_t channel, const std::vector<Comparison>& compared) {
  double before = 0, after = 0, floor = 0;
  for (const Comparison& each : compared) {
    before += std::pow(rms(series_of(channel, each.nominal, each.course, each.fix_times_s).values), 2);
    after += std::pow(rms(series_of(channel, each.improved, each.course, each.fix_times_s).values), 2);
    floor += std::pow(each.channel_floor[static_cast<Eigen::Index>(channel)], 2);
  }
  if (!(before > 0)) return std::nullopt;
  const auto n = static_cast<double>(compared.size());
  const auto& named = reported_channels()[channel];
  ChannelClosure one{std::string(named.name),
                     std::string(named.unit),
                     {std::sqrt(before / n), std::sqrt(after / n), std::sqrt(floor / n), {}, {}}};
  // Closure is a share of power: root mean squares do not add.
  if (floor > 0 && before > kChannelGapFactor * floor) one.closure.closed = 1 - (after - floor) / (before - floor);
  return one;
}

/// Root mean square of the heading's innovations, before and after.
std::optional<std::array<double, 2>> heading_errors_rad(const std::vector<Comparison>& compared) {
  std::array<double, 2> square{};
  double headings = 0;
  for (const Comparison& each : compared) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Innovations& which = i == 0 ? each.nominal : each.improved;
      for (Eigen::Index row = 0; row < which.grid.rows(); ++row) {
        const double missed = which.grid(row, heading);
        if (!std::isfinite(missed)) continue;
        square[i] += missed * missed;
        headings += 0.5;
      }
    }
  }
  if (!(headings > 0)) return std::nullopt;
  return std::array{std::sqrt(square[0] / headings), std::sqrt(square[1] / headings)};
}

/// Position error at surfacing for each 100 m through the water, before and after.
std::optional<std::array<double, 2>> dead_reckoning_m_per_100m(const std::vector<Comparison>& compared) {
  std::array<double, 2> error_m{}, distance_m{};
  for (const Comparison& each : compared) {
    for (std::size_t i = 0; i < 2; ++i) {
      for (const Resurfacing& one : (i == 0 ? each.nominal : each.improved).resurfacings) {
        if (one.distance_m < kLeastDistance_m) continue;
        error_m[i] += one.error_m;
        distance_m[i] += one.distance_m;
      }
    }
  }
  if (!(distance_m[0] > 0 && distance_m[1] > 0)) return std::nullopt;
  return std::array{100 * error_m[0] / distance_m[0], 100 * error_m[1] / distance_m[1]};
}

/// Writes the sentence of an explained gap, and the manoeuvres that separate its effects from others.
void write_explained(Diagnosis& answer) {
  std::vector<std::string> names;
  for (const EffectFinding& effect : answer.effects) names.push_back(effect.name);
  answer.sentence =
      fmt::format("{} {} the gap (probability {:.2f})", fmt::join(names, " and "),
                  answer.effects.size() == 1 ? "explains" : "explain", answer.effects.back().probability);
  if (answer.gap.pooled.closed) {
    answer.sentence += fmt::format(": {:.0f} % of it goes away{}.", 100 * std::min(1.0, *answer.gap.pooled.closed),
                                   answer.gap.held_out ? " on missions held out" : "");
  } else {
    answer.sentence += "; it is too small to say by how much it shrinks.";
  }
  if (answer.gap.pooled.closed_ci && (*answer.gap.pooled.closed_ci)[0] > kOverClosedFrom) {
    answer.remarks.emplace_back(
        "more of the gap goes away than there was above the floor: the floor is too high here");
  }
  for (const EffectFinding& effect : answer.effects) {
    for (const Confusion& other : effect.confused_with) {
      answer.next.push_back(fmt::format("to tell {} from {}: {}", effect.name, other.name, other.tie_breaker));
      break;
    }
  }
  answer.next.emplace_back("take the effects into the simulator and calibrate or mend what causes them");
}

std::string words_of(const Alternative& alternative, std::string_view between = " and ") {
  std::vector<std::string> words;
  for (const auto& effect : alternative.effects) words.push_back(effect.words());
  return fmt::format("{}", fmt::join(words, between));
}

/// Manoeuvres of the effects that only one of two sets holds.
std::string deciding_manoeuvres(const Alternative& one, const Alternative& other) {
  std::map<std::string, std::string> manoeuvres;
  for (const Alternative* each : {&one, &other}) {
    for (const EffectFinding& effect : each->effects) {
      const auto [at, is_new] = manoeuvres.try_emplace(effect.name + effect.of, effect.manoeuvre);
      if (!is_new) manoeuvres.erase(at);
    }
  }
  std::set<std::string_view> texts;
  for (const auto& [name, text] : manoeuvres) texts.insert(text);
  return fmt::format("{}", fmt::join(texts, "; and "));
}

/// Writes the candidates of an unexplained gap, and the manoeuvres that test them.
void write_candidates(Diagnosis& answer) {
  if (answer.candidates.empty() || answer.candidates.front().probability < kLikelyFrom) {
    answer.next.emplace_back("look at what is left unexplained and add an effect for it to the simulator");
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(answer.candidates.size(), 3); ++i) {
    const EffectFinding& candidate = answer.candidates[i];
    if (candidate.probability < kToldFrom) break;
    answer.unexplained.push_back(fmt::format(
        "candidate: {} fits {} of the library's effects, and {}", candidate.name, i == 0 ? "best" : "next best",
        answer.kind == UnknownKind::outside ? "does not explain the recording" : "is not certain"));
    answer.next.push_back(fmt::format("to see whether it is {}: {}", candidate.name, candidate.manoeuvre));
  }
}

}  // namespace

Alternative alternative_of(const ModelFit& fit, const Library& library, double probability,
                           std::optional<double> closed) {
  Alternative alternative{{}, probability, closed};
  for (const std::size_t effect : fit.effects) {
    alternative.effects.push_back(
        {std::string(library[effect].name), probability, parameters(effect, fit, library), {}});
    alternative.effects.back().manoeuvre = library[effect].manoeuvre.text();
  }
  return alternative;
}

bool shows_gap(const Diagnosis& answer) {
  return answer.gap.pooled.closed || std::ranges::any_of(answer.where, [](const WhereEntry& entry) {
           return entry.p_value <= kSignificantAgainstExactBelow;
         });
}

void write_unknown(UnknownKind kind, std::string_view reason, Diagnosis& answer) {
  answer.verdict = Verdict::unknown;
  answer.kind = kind;
  std::vector<std::string> sets;
  for (const Alternative& each : answer.alternatives) {
    const std::string closed =
        each.closed ? fmt::format(", {:.0f} % closed", 100 * std::min(1.0, *each.closed)) : "";
    sets.push_back(fmt::format("{} (probability {:.2f}{})", words_of(each), each.probability, closed));
  }
  switch (kind) {
    case UnknownKind::ambiguous:
      answer.sentence = fmt::format("Ambiguous: there is a gap, and {} explains it.", fmt::join(sets, ", or "));
      for (std::size_t i = 1; i < answer.alternatives.size(); ++i) {
        const Alternative &one = answer.alternatives.front(), &other = answer.alternatives[i];
        answer.next.push_back(fmt::format("to decide between {} and {}: {}", words_of(one, " + "),
                                          words_of(other, " + "), deciding_manoeuvres(one, other)));
      }
      return;
    case UnknownKind::outside:
      answer.sentence =
          "Outside the library: there is a gap, and neither an effect nor several together explain it";
      break;
    case UnknownKind::cannot_say:
      answer.sentence = shows_gap(answer) ? "The cause cannot be said" : "Whether there is a gap cannot be said";
      break;
  }
  answer.sentence += reason.empty() ? "." : fmt::format(": {}.", reason);
}

void write_findings(const FoundEffects& result, const Library& library, Diagnosis& answer) {
  const SearchResult& found = result.found;
  std::map<std::size_t, double> included;
  for (const Candidate& candidate : found.candidates) {
    for (const std::size_t effect : candidate.effects) included[effect] += candidate.probability;
  }
  const Evidence evidence = evidence_of(found.best.linear, result.priors);
  for (const auto& [effect, probability] : included) {
    const auto& set = found.best.effects;
    const bool member = std::ranges::find(set, effect) != set.end();
    if (!member && probability < kReportedFrom) continue;
    EffectFinding finding{std::string(library[effect].name), std::min(probability, 1.0), {}, {}};
    finding.manoeuvre = library[effect].manoeuvre.text();
    if (member) {
      finding.parameters = parameters(effect, found.best, library);
      finding.confused_with = confusions(effect, found, library, evidence);
      if (answer.verdict == Verdict::explained) answer.effects.push_back(finding);
    }
    answer.candidates.push_back(std::move(finding));
  }
  std::ranges::stable_sort(answer.effects, std::ranges::greater(), &EffectFinding::probability);
  std::ranges::stable_sort(answer.candidates, std::ranges::greater(), &EffectFinding::probability);
}

void write_gap(const std::vector<Comparison>& compared, const PooledClosure& closure, bool held_out,
               Diagnosis& answer) {
  Gap& gap = answer.gap;
  gap.held_out = held_out;
  gap.pooled = {closure.before, closure.after, closure.floor, {}, {}};
  if (closure.clear) {
    gap.pooled.closed = closure.closed;
    gap.pooled.closed_ci = std::array<double, 2>{closure.lower, closure.upper};
  }
  for (std::size_t channel = 0; channel < reported_channels().size(); ++channel) {
    if (auto one = closure_of(channel, compared)) gap.channels.push_back(std::move(*one));
  }
  gap.heading_error_rad = heading_errors_rad(compared);
  gap.dead_reckoning_m_per_100m = dead_reckoning_m_per_100m(compared);
}

void write_words(Diagnosis& answer) {
  switch (answer.verdict) {
    case Verdict::no_gap:
      answer.sentence =
          "No gap: this recording shows nothing beyond what a vehicle within 2 % of the model shows.";
      if (const auto count = answer.instruments.not_judged.size(); count > 0) {
        answer.sentence +=
            fmt::format(" {} effects were not judged: an instrument that shows them is missing.", count);
      }
      return;
    case Verdict::explained: write_explained(answer); return;
    case Verdict::unknown:
      write_unknown(answer.kind, answer.unexplained.empty() ? "" : answer.unexplained.front(), answer);
      if (answer.kind != UnknownKind::ambiguous) write_candidates(answer);
      return;
  }
}

}  // namespace navcal::gap

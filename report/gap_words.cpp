// SPDX-License-Identifier: Apache-2.0
#include "report/gap_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/angles.h"
#include "base/line_reader.h"
#include "gap/thresholds.h"
#include "report/calibrate_words.h"
#include "report/shown_number.h"

namespace navcal::report {
namespace {

constexpr std::string_view kNoNumber = "-";

/// The text quoted for a shell.
std::string quoted(const std::string& file) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._/-+=,:@%";
  if (!file.empty() && file.find_first_not_of(kPlain) == std::string::npos) return file;
  std::string out = "'";
  for (const char c : file) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

constexpr std::array<std::string_view, 11> kChannelUnits{"uT", "deg", "rad", "s", "s2", "m",
                                                         "N",  "A",   "A2",  "C", "g"};

bool is_unit(std::string_view word) { return std::ranges::find(kChannelUnits, word) != kChannelUnits.end(); }

}  // namespace

std::string_view verdict_word(gap::Verdict verdict) {
  return verdict == gap::Verdict::no_gap ? "no gap" : gap::name_of(verdict);
}

std::string_view candidates_heading(gap::UnknownKind kind) {
  switch (kind) {
    case gap::UnknownKind::ambiguous: return "Each of these sets of effects explains the recording.";
    case gap::UnknownKind::outside:
      return "The best fits of the library, in order; none of them explains the recording.";
    case gap::UnknownKind::cannot_say: break;
  }
  return "The best fits of the library, in order; whether one of them is the cause cannot be said.";
}

std::string verdict_sentence(const gap::Diagnosis& diagnosis) {
  if (!diagnosis.sentence.empty()) return diagnosis.sentence;
  switch (diagnosis.verdict) {
    case gap::Verdict::no_gap: return "No residuals exceed those of the nominal vehicle.";
    case gap::Verdict::explained: return "The effects below explain the gap.";
    case gap::Verdict::unknown: break;
  }
  return "No effect of the library explains the recording.";
}

std::vector<std::string> further_remarks(const gap::Diagnosis& diagnosis) {
  std::vector<std::string> remarks = diagnosis.remarks;
  std::erase_if(remarks,
                [&](const std::string& remark) { return diagnosis.sentence.find(remark) != std::string::npos; });
  return remarks;
}

std::string nowhere_text(const gap::Diagnosis& diagnosis) {
  if (diagnosis.map.empty() && diagnosis.gap.pooled.before > 0) return "In no channel alone.";
  return diagnosis.map.empty() ? "There was no comparison with the nominal vehicle."
                               : "Nowhere: no residuals differ significantly from those of the nominal vehicle.";
}

std::string source_text(const gap::Diagnosis& diagnosis) {
  const auto& sources = diagnosis.sources;
  if (sources.empty() || sources.front().gain_nats < gap::kObservable_nats) return {};
  const auto named = [](const gap::SourceFinding& source) {
    double strength = 0;
    for (const gap::ErrorFinding& error : source.errors) strength = std::max(strength, error.strength);
    const std::string doubt =
        source.closes_nothing ? ", which has nothing to close on its own channel"
        : strength > gap::kLargestStrength
            ? fmt::format(", whose error would be {} times as large as usual", amount(strength))
            : "";
    return fmt::format("{} ({}){}", source.words, source.name, doubt);
  };
  if (sources.size() == 1) return fmt::format("{}; no other source describes it", named(sources[0]));
  const double apart = sources[0].gain_nats - sources[1].gain_nats;
  if (sources[1].closes_nothing) return fmt::format("{}; not {}", named(sources[0]), named(sources[1]));
  if (apart < gap::kObservable_nats) {
    return fmt::format("{} or {}: they cannot be told apart here ({} nats)", named(sources[0]), named(sources[1]),
                       amount(apart));
  }
  return fmt::format("{}; next best, {} nats worse: {}", named(sources[0]), amount(apart), named(sources[1]));
}

std::vector<std::string> proposal_lines(const gap::Diagnosis& diagnosis, std::string_view plus_minus,
                                        std::string_view arrow) {
  if (!diagnosis.proposal) return {};
  const gap::Proposal& proposal = *diagnosis.proposal;
  std::vector<std::string> lines;
  for (const gap::ErrorFinding& error : proposal.source.errors) {
    lines.push_back(fmt::format("{} of {} is off by {} {} {} and follows {}", error.component,
                                proposal.source.words, amount(error.rms), plus_minus,
                                amount(error.std_error, error.unit), spaced(error.follows)));
  }
  const std::string on = proposal.held_out ? "on the recordings held out" : "on minutes of this recording";
  lines.push_back(fmt::format("{} it gains {} nats: noise power {} {} {}, of the nominal vehicle {}", on,
                              amount(proposal.held_out_gain_nats), amount(proposal.power.before), arrow,
                              amount(proposal.power.after), amount(proposal.power.floor)));
  lines.emplace_back(kDescriptionNotCause);
  return lines;
}

std::string spaced(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string amount(double value, std::string_view unit) {
  if (!std::isfinite(value)) return std::string(kNoNumber);
  const double size = std::abs(value);
  const std::string digits =
      size >= 999.5 && size < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
  return unit.empty() ? digits : fmt::format("{} {}", digits, unit);
}

std::string share_text(double share) {
  if (!std::isfinite(share)) return std::string(kNoNumber);
  return fmt::format("{:.0f} %", std::round(100 * share) + 0.0);
}

std::string probability_text(double probability) {
  if (!std::isfinite(probability)) return std::string(kNoNumber);
  if (probability > 0.999) return "> 99.9 %";
  if (probability < 0.001) return "< 0.1 %";
  return fmt::format("{:.1f} %", 100 * probability);
}

std::string chance_text(double p_value) {
  if (!std::isfinite(p_value)) return std::string(kNoNumber);
  if (p_value < 1e-12) return "< 1e-12";
  if (p_value >= 0.001) return fmt::format("{:.2g}", p_value);
  return fmt::format("1e{:.0f}", std::ceil(std::log10(p_value)));
}

std::string text_of(const gap::EffectParameterEstimate& parameter, std::string_view plus_minus) {
  const auto [name, unit] = name_and_unit(parameter.name);
  std::string text = name + (name.empty() ? "" : " ");
  if (std::isfinite(parameter.value)) {
    text += fmt::format("{:.{}f}", parameter.value, decimals_for(parameter.value, parameter.std_error));
  } else {
    text += kNoNumber;
  }
  if (std::isfinite(parameter.std_error)) {
    text += fmt::format(" {} {:.{}f}", plus_minus, parameter.std_error,
                        decimals_for(parameter.std_error, parameter.std_error));
  }
  return unit.empty() ? text : text + " " + unit;
}

std::string text_of(const gap::Confusion& confusion) {
  std::string text = "may as well be " + confusion.name;
  if (std::isfinite(confusion.separation_nats)) {
    text += fmt::format(" ({:.1f} nats apart)", confusion.separation_nats);
  }
  return confusion.tie_breaker.empty() ? text : text + "; told apart by: " + confusion.tie_breaker;
}

std::string closed_text(const gap::Closure& closure) {
  // Further below zero the digits of a share have no meaning: the residuals have grown.
  constexpr double kGrows = -1;
  if (!closure.closed || !std::isfinite(*closure.closed)) return "nothing to close";
  if (*closure.closed < kGrows) return "grows";
  // No more than the whole gap can go away. By chance the rest may be smaller than the floor.
  const auto share = [](double closed) { return share_text(std::min(closed, 1.0)); };
  std::string text = share(*closure.closed);
  if (closure.closed_ci && closure.closed_ci->front() < kGrows) {
    text += fmt::format(" (at most {})", share(closure.closed_ci->back()));
  } else if (closure.closed_ci) {
    text += fmt::format(" ({:.0f} to {})", 100 * std::min(closure.closed_ci->front(), 1.0),
                        share(closure.closed_ci->back()));
  }
  return text;
}

std::string levels_text(const gap::Closure& closure, std::string_view unit, std::string_view arrow) {
  return fmt::format("{} {} {}, floor {}", amount(closure.before), arrow, amount(closure.after, unit),
                     amount(closure.floor, unit));
}

std::string size_text(const gap::Closure& closure) {
  if (closure.before == 0 && closure.floor == 0) return "not determined";
  return fmt::format("noise power {}, of the nominal vehicle {}", amount(closure.before), amount(closure.floor));
}

std::string judged_on(const gap::Gap& gap, const GapSource& source) {
  if (!gap.held_out) return "on blocks of the same recording, which is a weaker check than another recording";
  const std::size_t n = source.holdouts.size();
  return n == 1 ? "on the held-out recording" : fmt::format("on {} held-out recordings", n);
}

std::vector<std::string> consequences(const gap::Gap& gap, std::string_view arrow) {
  std::vector<std::string> sentences;
  if (gap.heading_error_rad) {
    sentences.push_back(fmt::format("heading error {} {} {} RMS",
                                    amount(base::kDegreesPerRadian * gap.heading_error_rad->front()), arrow,
                                    amount(base::kDegreesPerRadian * gap.heading_error_rad->back(), "deg")));
  }
  if (gap.dead_reckoning_m_per_100m) {
    sentences.push_back(fmt::format("position error {} {} {} in 100 m between fixes",
                                    amount(gap.dead_reckoning_m_per_100m->front()), arrow,
                                    amount(gap.dead_reckoning_m_per_100m->back(), "m")));
  }
  return sentences;
}

std::string text_of(const gap::ChangePoint& change, std::string_view arrow) {
  return fmt::format("{} at {}: {} {} {}", change.channel, amount(change.time_s, "s"), amount(change.before),
                     arrow, amount(change.after, change.unit));
}

std::vector<std::string> instruments_alone_lines(const calib::Report& report, std::string_view plus_minus) {
  std::vector<std::string> lines;
  for (const auto& calibrator : report.calibrators) {
    if (calib::row_of(calibrator.calibrator).by_order) continue;  // only an operator can begin it
    std::string line = fmt::format("{}: ", title_of(calibrator.calibrator));
    if (calibrator.outcome == calib::Outcome::refused) {
      lines.push_back(line + "not determined, " + objection_of(calibrator));
      continue;
    }
    std::vector<std::string> pieces;
    for (const ShownQuantity& quantity : shown(calibrator)) pieces.push_back(text_of(quantity, plus_minus));
    line += fmt::format("{}", fmt::join(pieces, ", "));
    if (const auto held_out = held_out_of(calibrator, "to"); !held_out.empty())
      line += fmt::format("; on held-out readings from {}", held_out);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string bank_text(const gap::BankFacts& bank) {
  if (bank.missions <= 0) return "no bank of nominal missions";
  const std::string from = bank.from_cache ? "from the cache" : "made in " + duration_text(bank.seconds);
  return fmt::format("{} simulated missions of the nominal vehicle, seed {}, {}", bank.missions, bank.seed, from);
}

std::string simulate_hint(const gap::Diagnosis& diagnosis, const GapSource& source) {
  if (diagnosis.effects.empty()) return {};
  const std::string file = source.effects_file.empty() ? "FILE.toml" : quoted(source.effects_file);
  std::string nominal = source.vehicle.empty() ? "" : " --vehicle " + quoted(source.vehicle);
  if (!source.config.empty()) nominal += " --config " + quoted(source.config);
  const std::string command =
      fmt::format("navcal simulate --mission survey{} --effects {} -o with.cap", nominal, file);
  return source.effects_file.empty() ? "--effects-out FILE.toml writes the effects found; then " + command
                                     : command;
}

NameAndUnit name_and_unit(std::string_view parameter) {
  NameAndUnit split;
  bool per = false;
  while (!parameter.empty()) {
    const std::string_view word = base::take_until(parameter, "_");
    if (word == "per") {
      per = true;
    } else if (is_unit(word)) {
      // Metres by seconds squared are written m_s2, without "per".
      if (!split.unit.empty()) split.unit += '/';
      if (split.unit.empty() && per) split.unit = "1/";
      split.unit += word;
    } else {
      if (!split.name.empty()) split.name += ' ';
      split.name += word;
    }
  }
  return split;
}

}  // namespace navcal::report

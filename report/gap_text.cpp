// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>
#include <vector>

#include "base/append_format.h"
#include "report/gap_report.h"
#include "report/shown_number.h"
#include "report/wrapped_text.h"

namespace navcal::report {
namespace {

constexpr std::string_view kPlusMinusText = "+-", kArrowText = "->";
constexpr std::size_t kTitleWidth = 17;  ///< column at which the text begins
constexpr std::size_t kMostWhere = 5, kMostCandidates = 5;

/// Title in the left column; empty on the following lines.
void begin(std::string& out, std::string_view title) { base::append_format(out, "{:<{}}", title, kTitleWidth); }

void append_lines(std::string& out, std::string_view title, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    begin(out, title);
    append_wrapped(out, kTitleWidth, words_of(line), " ");
    title = {};
  }
}

void append_where(std::string& out, const gap::Diagnosis& diagnosis) {
  const auto& where = diagnosis.where;
  if (where.empty()) return append_lines(out, "where", {nowhere_text(diagnosis)});
  begin(out, "where");
  base::append_format(out, "{:<20}{:<24}{:<18}{:<12}{}\n", "channel", "follows", "gap", "nominal", "by chance");
  for (std::size_t i = 0; i < std::min(where.size(), kMostWhere); ++i) {
    const auto& entry = where[i];
    begin(out, {});
    base::append_format(out, "{:<19} {:<23} {:<17} {:<11} {}\n", entry.channel, spaced(entry.regime),
                        amount(entry.gap, entry.unit), amount(entry.floor), chance_text(entry.p_value));
  }
  if (where.size() > kMostWhere) {
    begin(out, {});
    base::append_format(out, "and {} more, in --json and --report\n", where.size() - kMostWhere);
  }
}

/// Text without a probability, if that is only a share among effects of which none explains the recording.
void append_effect(std::string& out, const gap::EffectFinding& effect, bool with_probability) {
  constexpr std::size_t kIndent = kTitleWidth + 2;
  out += effect.words();
  if (with_probability) base::append_format(out, ", {}", probability_text(effect.probability));
  out += '\n';
  std::vector<std::string> pieces;
  for (const auto& parameter : effect.parameters) pieces.push_back(text_of(parameter, kPlusMinusText));
  if (!pieces.empty()) {
    out.append(kIndent, ' ');
    append_wrapped(out, kIndent, pieces, ",  ");
  }
  for (const auto& other : effect.confused_with) {
    out.append(kIndent, ' ');
    append_wrapped(out, kIndent, words_of(text_of(other)), " ");
  }
}

void append_effects(std::string& out, std::string_view title, const std::vector<gap::EffectFinding>& effects,
                    std::size_t most, bool with_probability) {
  for (std::size_t i = 0; i < std::min(effects.size(), most); ++i) {
    begin(out, i == 0 ? title : "");
    append_effect(out, effects[i], with_probability);
  }
}

void append_closure(std::string& out, const gap::Gap& gap, const GapSource& source) {
  append_lines(out, "closed",
               {closed_text(gap.pooled) + ": noise power " + levels_text(gap.pooled, {}, kArrowText) + "; " +
                judged_on(gap, source)});
  for (const auto& channel : gap.channels) {
    begin(out, {});
    base::append_format(out, "{:<19} {:<24} {}\n", channel.channel, closed_text(channel.closure),
                        levels_text(channel.closure, channel.unit, kArrowText));
  }
}

}  // namespace

std::string gap_text(const gap::Diagnosis& diagnosis, const GapSource& source) {
  std::string out;
  append_lines(out, verdict_word(diagnosis.verdict), {verdict_sentence(diagnosis)});
  if (diagnosis.instruments_alone) {
    append_lines(out, "instruments", instruments_alone_lines(*diagnosis.instruments_alone, kPlusMinusText));
    append_lines(out, "remarks", further_remarks(diagnosis));
    return out;
  }
  append_where(out, diagnosis);
  if (const std::string from = source_text(diagnosis); !from.empty()) append_lines(out, "enters at", {from});
  append_lines(out, "description", proposal_lines(diagnosis, kPlusMinusText, kArrowText));
  if (!diagnosis.effects.empty()) {
    append_effects(out, "causes", diagnosis.effects, diagnosis.effects.size(), true);
    append_closure(out, diagnosis.gap, source);
  } else {
    append_lines(out, "how much", {size_text(diagnosis.gap.pooled)});
    const bool unknown = diagnosis.verdict == gap::Verdict::unknown;
    const bool any = unknown && !diagnosis.candidates.empty();
    const bool several = unknown && diagnosis.kind == gap::UnknownKind::ambiguous;
    const std::string_view title = several ? "either" : "not convincing";
    if (any) append_lines(out, title, {std::string(candidates_heading(diagnosis.kind))});
    for (const auto& set : diagnosis.alternatives)
      append_effects(out, "or", set.effects, set.effects.size(), true);
    if (!several) append_effects(out, any ? "" : title, diagnosis.candidates, kMostCandidates, !unknown);
  }
  append_lines(out, "consequence", consequences(diagnosis.gap, kArrowText));
  append_lines(out, "left over", diagnosis.unexplained);
  std::vector<std::string> changes;
  for (const auto& change : diagnosis.changes) changes.push_back(text_of(change, kArrowText));
  append_lines(out, "changed", changes);
  append_lines(out, "to do", diagnosis.next);
  if (const auto hint = simulate_hint(diagnosis, source); !hint.empty()) append_lines(out, "to simulate", {hint});
  append_lines(out, "remarks", further_remarks(diagnosis));
  if (diagnosis.field) append_lines(out, "Earth's field", {gap::text_of(*diagnosis.field)});
  append_lines(out, "made from",
               {duration_text(diagnosis.duration_s) + " of mission in " + duration_text(diagnosis.seconds) + "; " +
                bank_text(diagnosis.bank)});
  return out;
}

}  // namespace navcal::report

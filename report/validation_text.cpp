// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/append_format.h"
#include "report/validation_report.h"
#include "report/validation_words.h"

namespace navcal::report {
namespace {

/// The scores as a table.
std::string scores_text(const std::vector<validation::TrialScore>& scores) {
  constexpr int kNameWidth = 42;
  constexpr const char* kRow = "{:<{}}{:>9}  {:<16}{:<13}{:<16}{}\n";
  std::string out = fmt::format(kRow, "", kNameWidth, "score", "95 %", "cases", "target", "");
  for (const validation::TrialScore& score : scores) {
    std::string row = fmt::format(kRow, score.name, kNameWidth, value_text(score), interval_text(score),
                                  count_text(score), target_text(score), met_text(score));
    row.erase(row.find_last_not_of(" \n") + 1);
    out += row + '\n';
  }
  return out;
}

void append_mistakes(std::string& out, const TrialReport& report) {
  constexpr int kShown = 20;
  int mistakes = 0;
  for (const validation::TrialResult& result : report.results) {
    if (!is_mistake(result) || ++mistakes > kShown) continue;
    if (mistakes == 1) out += "\nMistakes:\n";
    base::append_format(out, "  case {} ({}): {}; answered {}\n", result.drawn.number,
                        validation::facts_of(result.drawn.arm).name, truth_words(result.drawn),
                        answer_words(result));
  }
  if (mistakes > kShown)
    base::append_format(out, "  and {} more, which --json and --report list\n", mistakes - kShown);
  if (mistakes > 0) base::append_format(out, "One of them again: {}\n", rerun_command(report));
}

}  // namespace

std::string trial_words(const TrialReport& report) {
  const std::string missions = fmt::format("seed {}, missions of {} minutes, ", report.seed, report.minutes);
  const validation::LayoutTrial& on = report.on_layouts;
  if (on.layouts.empty()) return missions + fmt::format("{} places", report.places);
  std::string layouts;
  for (const auto& layout : on.layouts) layouts.append(layouts.empty() ? "" : ", ").append(layout.name);
  return missions + fmt::format("{} vehicles by {}, off by {:g} %, with {} nominal recordings each", on.vehicles,
                                layouts, 100 * on.layout_error, on.nominal);
}

std::string rerun_command(const TrialReport& report) {
  std::string vehicles = fmt::format("--places {}", report.places);
  if (const validation::LayoutTrial& on = report.on_layouts; !on.layouts.empty()) {
    vehicles = fmt::format("--vehicles {} --nominal {} --layout-error {} --unmodelled {}", on.vehicles, on.nominal,
                           on.layout_error, on.unmodelled);
    for (const auto& layout : on.layouts) vehicles += " --layout " + layout.name;
  }
  return fmt::format("navcal gap trial --seed {} --minutes {} {} --only CASE --keep DIR", report.seed,
                     report.minutes, vehicles);
}

std::string trial_text(const TrialReport& report) {
  std::string out =
      fmt::format("\n{} of {} cases answered, {}\n", report.results.size(), report.asked_for, trial_words(report));
  if (!report.ended_early.empty()) base::append_format(out, "Ended early: {}\n", report.ended_early);
  out += '\n';
  out += scores_text(report.scores.scores);
  append_mistakes(out, report);
  out += '\n' + targets_text(report.scores) + '\n';
  return out;
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/append_format.h"
#include "report/validation_report.h"
#include "report/validation_words.h"

namespace navcal::report {
namespace {

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
  if (mistakes > 0) base::append_format(out, "One of them again: {}\n", rerun_command(report, 0));
}

}  // namespace

std::string rerun_command(const TrialReport& report, int number) {
  return fmt::format("navcal gap trial --seed {} --minutes {} --places {} --only {} --keep DIR", report.seed,
                     report.minutes, report.places, number > 0 ? std::to_string(number) : "CASE");
}

std::string trial_text(const TrialReport& report) {
  std::string out =
      fmt::format("\n{} of {} cases answered, seed {}, missions of {} minutes, {} places\n", report.results.size(),
                  report.asked_for, report.seed, report.minutes, report.places);
  if (!report.ended_early.empty()) base::append_format(out, "Ended early: {}\n", report.ended_early);
  out += '\n';
  out += scores_text(report.scores.scores, 42);
  append_mistakes(out, report);
  out += '\n' + targets_text(report.scores) + '\n';
  return out;
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "report/html_page.h"
#include "report/validation_figures.h"
#include "report/validation_report.h"
#include "report/validation_words.h"

namespace navcal::report {
namespace {

void append_verdict(HtmlPage& page, const TrialReport& report) {
  bool missed = false;
  for (const validation::TrialScore& score : report.scores.scores) {
    if (score.met() != false) continue;
    missed = true;
    page.fact("bad", "missed",
              fmt::format("{}: {} ({}), target {}.", score.name, value_text(score), count_text(score),
                          target_text(score)));
  }
  page.fact(missed ? "plain" : "good", "targets", targets_text(report.scores));
  page.fact("plain", "cases",
            fmt::format("{} of {} answered; seed {}, missions of {} minutes, {} places.", report.results.size(),
                        report.asked_for, report.seed, report.minutes, report.places));
  if (!report.ended_early.empty()) page.fact("bad", "ended early", report.ended_early + ".");
}

void append_scores(HtmlPage& page, const validation::TrialScores& scores) {
  std::vector<std::vector<std::string>> rows;
  for (const validation::TrialScore& score : scores.scores) {
    rows.push_back({score.name, value_text(score), interval_text(score), count_text(score), target_text(score),
                    met_text(score)});
  }
  page.section("Scores");
  page.table({"", "Score", "95 % interval", "Cases", "Target", ""}, rows);
}

void append_arms(HtmlPage& page, const validation::TrialScores& scores) {
  std::vector<std::string> heads{"Arm", "What"};
  for (int i = 0; i < validation::kTrialOutcomes; ++i)
    heads.emplace_back(validation::name_of(static_cast<validation::TrialOutcome>(i)));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t arm = 0; arm < scores.outcomes.size(); ++arm) {
    std::vector<std::string> row{std::string(validation::trial_arms()[arm].name),
                                 std::string(validation::trial_arms()[arm].what)};
    int cases = 0;
    for (const int count : scores.outcomes[arm]) {
      cases += count;
      row.push_back(count > 0 ? std::to_string(count) : "");
    }
    if (cases > 0) rows.push_back(std::move(row));
  }
  page.section("Answers by arm");
  page.table(heads, rows);
}

void append_cases(HtmlPage& page, const TrialReport& report, const char* title,
                  bool (*belongs)(const validation::TrialResult&)) {
  std::vector<std::vector<std::string>> rows;
  for (const validation::TrialResult& result : report.results) {
    if (!belongs(result)) continue;
    rows.push_back({std::to_string(result.drawn.number), std::string(validation::facts_of(result.drawn.arm).name),
                    truth_words(result.drawn), answer_words(result),
                    result.answer && !result.answer->channels.empty() ? result.answer->channels.front() : ""});
  }
  page.section(title);
  if (rows.empty()) return page.paragraph("None.");
  page.paragraph("One of them again: " + rerun_command(report, 0));
  page.table({"Case", "Arm", "Truth", "Answer", "Strongest channel"}, rows);
}

void append_seals(HtmlPage& page, const TrialReport& report) {
  std::vector<std::vector<std::string>> rows;
  for (const validation::TrialResult& result : report.results)
    rows.push_back({std::to_string(result.drawn.number), result.seal.digest, result.seal.salt, result.seal.truth});
  page.section("Seals");
  page.paragraph(
      "The digests were published before the first case was diagnosed, truths and salts after the last answer: "
      "digest = SHA-256 of truth and salt, one after the other.");
  page.table({"Case", "SHA-256", "Salt", "Truth"}, rows);
}

}  // namespace

std::string trial_page(const TrialReport& report) {
  HtmlPage page("Diagnosis on withheld effects");
  append_verdict(page, report);
  append_scores(page, report.scores);
  if (const auto figures = trial_figures(report.scores); !figures.empty()) {
    page.section("Detectable strength, reliability of the answers, closure of the gap");
    page.figures(figures);
  }
  append_arms(page, report.scores);
  if (const auto figures = confusion_figure(report.confusion); !figures.empty()) {
    page.section("Confusion");
    page.figures(figures);
  }
  append_cases(page, report, "Mistakes", is_mistake);
  append_cases(page, report, "Not named, at half the typical strength or more", is_miss);
  append_seals(page, report);
  return std::move(page).finish();
}

}  // namespace navcal::report

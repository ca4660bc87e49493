// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "report/html_page.h"
#include "report/svg_matrix.h"
#include "report/svg_plot.h"
#include "report/validation_report.h"
#include "report/validation_words.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;

std::vector<Figure> power_figure(const std::vector<validation::TrialPower>& power) {
  std::vector<Point> lower, upper, shares;
  for (const auto& [strength, hits, cases] : power) {
    if (cases == 0) continue;
    const auto interval = validation::wilson(hits, cases);
    lower.push_back({strength, 100 * interval[0]});
    upper.push_back({strength, 100 * interval[1]});
    shares.push_back({strength, 100.0 * hits / cases});
  }
  if (shares.empty()) return {};
  SvgPlot plot("Power", {"strength, typical strengths", {0, 2.1}}, {"named exactly, %", {0, 103}});
  plot.band(Ink::first, "95 %", lower, upper);
  plot.line(Ink::first, "", shares);
  plot.points(Ink::first, "share", shares);
  const std::array<Point, 4> targets{{{0.1, 100.0 / 3}, {0.2, 80}, {0.5, 95}, {1, 95}}};
  plot.points(Ink::before, "target", targets);
  return {{"Power against the size of the gap", plot.svg(),
           "Share of single effects that were named exactly, by strength."}};
}

std::vector<Figure> calibration_figure(const validation::TrialScores& scores) {
  std::vector<Point> points;
  SvgPlot plot("Calibration", {"probability given, %", {0, 103}}, {"right, %", {0, 103}}, {440, 400});
  const std::array<Point, 2> ideal{{{0, 0}, {100, 100}}};
  plot.line(Ink::fit, "ideal", ideal);
  for (const validation::TrialCalibrationBin& bin : scores.calibration) {
    if (bin.bets == 0) continue;
    const int right = static_cast<int>(std::lround(bin.share_right * bin.bets));
    const auto interval = validation::wilson(right, bin.bets);
    const double x = 100 * bin.mean_probability;
    const std::array<Point, 2> bar{{{x, 100 * interval[0]}, {x, 100 * interval[1]}}};
    plot.line(Ink::first, "", bar);
    points.push_back({x, 100 * bin.share_right});
  }
  if (points.empty()) return {};
  plot.points(Ink::before, "in tenths, with 95 %", points);
  return {
      {"Calibration of the probabilities", plot.svg(),
       fmt::format(
           "Probabilities of effects in explained cases against the share that was present; mean distance {:.3f}.",
           validation::calibration_error(scores.calibration))}};
}

std::vector<Figure> closure_figure(const std::vector<double>& closures) {
  if (closures.empty()) return {};
  constexpr double kLeast = 0.7, kMost = 1.2, kWidth = 0.02;
  constexpr int kBins = 25;
  std::array<int, kBins> counts{};
  for (const double closure : closures) {
    const double place = (std::clamp(closure, kLeast, kMost) - kLeast) / kWidth;
    ++counts[static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, kBins - 1))];
  }
  const int most = *std::ranges::max_element(counts);
  SvgPlot plot("Closure", {"part of the held-out gap closed, %", {100 * kLeast, 100 * kMost}},
               {"cases", {0, 1.08 * most}});
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double left = 100 * (kLeast + kWidth * static_cast<double>(i)), right = left + 100 * kWidth;
    const std::array<Point, 2> floor{{{left, 0}, {right, 0}}};
    const std::array<Point, 2> ceiling{{{left, 1.0 * counts[i]}, {right, 1.0 * counts[i]}}};
    plot.band(Ink::first, "", floor, ceiling);
    plot.line(Ink::first, "", ceiling);
  }
  return {{"Closure", plot.svg(),
           fmt::format("{} exact outcomes at half the typical strength or more; values outside the axis are in "
                       "the outermost bars.",
                       closures.size())}};
}

/// Power by strength, calibration of the probabilities, closures; figures without cases are left out.
std::vector<Figure> trial_figures(const validation::TrialScores& scores) {
  std::vector<Figure> figures = power_figure(scores.power);
  for (auto& more : {calibration_figure(scores), closure_figure(scores.closures)})
    figures.insert(figures.end(), more.begin(), more.end());
  return figures;
}

/// Empty if nothing was answered.
std::vector<Figure> confusion_figure(const validation::TrialConfusion& confusion) {
  if (confusion.truths.empty()) return {};
  SvgMatrix matrix{confusion.truths, confusion.answers, confusion.counts, {}};
  for (const std::string& truth : confusion.truths) {
    matrix.agreeing.emplace_back();
    for (const std::string& answer : confusion.answers) {
      const bool nothing_to_name = truth.ends_with("the library") || truth == "6 % off everywhere";
      const bool nothing_there = truth == "no effect" || truth == "6 % off everywhere";
      matrix.agreeing.back().push_back(truth == answer || (nothing_to_name && answer == "unknown") ||
                                       (nothing_there && answer == "no gap"));
    }
  }
  return {{"Truth (rows) against answer (columns)", matrix.svg("Confusion matrix"),
           "Blue: right. Orange: wrong. A case counts for each effect that is present; effects at less than half "
           "their typical strength and the poor missions are left out."}};
}

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
            fmt::format("{} of {} answered; {}.", report.results.size(), report.asked_for, trial_words(report)));
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
  page.paragraph("One of them again: " + rerun_command(report));
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

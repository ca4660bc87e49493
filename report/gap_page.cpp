// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/angles.h"
#include "report/gap_figures.h"
#include "report/gap_report.h"
#include "report/html_page.h"
#include "report/shown_number.h"

namespace navcal::report {
namespace {

constexpr std::size_t kMostWhereRows = 5;

std::string joined(const std::vector<std::string>& parts) { return fmt::format("{}", fmt::join(parts, "; ")); }

void append_summary(HtmlPage& page, const gap::Diagnosis& diagnosis, const GapSource& source) {
  const bool good = diagnosis.verdict != gap::Verdict::unknown;
  page.fact(good ? "good" : "bad", verdict_word(diagnosis.verdict), verdict_sentence(diagnosis));
  if (diagnosis.instruments_alone) {
    for (const auto& line : instruments_alone_lines(*diagnosis.instruments_alone, kPlusMinus))
      page.fact("plain", "instruments", line);
  } else if (!diagnosis.effects.empty()) {
    page.fact("plain", "closed",
              closed_text(diagnosis.gap.pooled) + " of the gap, " + judged_on(diagnosis.gap, source) + ".");
  } else {
    page.fact("plain", "how much", size_text(diagnosis.gap.pooled));
  }
  if (const auto all = consequences(diagnosis.gap, kArrow); !all.empty()) page.fact("plain", "means", joined(all));
  for (const auto& step : diagnosis.next) page.fact("plain", "to do", step);
  for (const auto& remark : further_remarks(diagnosis)) page.fact("plain", "remark", remark);
}

void append_where(HtmlPage& page, const gap::Diagnosis& diagnosis) {
  page.section("Where it lies");
  if (diagnosis.where.empty()) {
    page.paragraph(nowhere_text(diagnosis));
  } else {
    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 0; i < std::min(diagnosis.where.size(), kMostWhereRows); ++i) {
      const auto& entry = diagnosis.where[i];
      rows.push_back({entry.channel, spaced(entry.regime), amount(entry.gap, entry.unit),
                      amount(entry.floor, entry.unit), chance_text(entry.p_value)});
    }
    page.table({"Channel", "Follows", "Gap", "Nominal vehicle", "By chance"}, rows);
  }
  if (const std::string from = source_text(diagnosis); !from.empty())
    page.paragraph("The error enters at: " + from + ".");
  if (const auto lines = proposal_lines(diagnosis, kPlusMinus, kArrow); !lines.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& line : lines) rows.push_back({line});
    page.table({"Description of what no effect explains"}, rows);
  }
  // In two columns the map would be cut off.
  if (auto figure = map_figure(diagnosis)) page.figures({std::move(*figure)});
  if (auto figure = track_figure(diagnosis)) page.figures({std::move(*figure)});
}

void append_causes(HtmlPage& page, const gap::Diagnosis& diagnosis, const GapSource& source) {
  page.section("What causes it");
  std::vector<Figure> figures;
  if (auto causes = cause_figure(diagnosis)) figures.push_back(std::move(*causes));
  if (auto closures = closure_figure(diagnosis, source)) figures.push_back(std::move(*closures));
  if (figures.empty()) {
    page.paragraph("No cause was considered likely.");
  } else {
    page.figures(figures);
  }
  if (const auto hint = simulate_hint(diagnosis, source); !hint.empty()) page.paragraph("To simulate it: " + hint);
}

void append_left_over(HtmlPage& page, const gap::Diagnosis& diagnosis) {
  if (diagnosis.unexplained.empty() && diagnosis.changes.empty()) return;
  page.section("Remaining residuals");
  for (const auto& sentence : diagnosis.unexplained) page.fact("plain", "left", sentence);
  for (const auto& change : diagnosis.changes) page.fact("plain", "changed", text_of(change, kArrow));
}

void append_residuals(HtmlPage& page, const gap::Diagnosis& diagnosis) {
  auto scatter = scatter_figure(diagnosis);
  auto [figures, others] = course_figures(diagnosis);
  if (scatter) figures.insert(figures.begin(), std::move(*scatter));
  if (figures.empty() && others.empty()) return;
  page.section("Residuals before and after");
  if (!figures.empty()) page.figures(figures);
  if (!others.empty()) page.folded_figures(figures.empty() ? "All channels" : "The other channels", others);
}

void append_source(HtmlPage& page, const gap::Diagnosis& diagnosis, const GapSource& source) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& file : source.missions) rows.push_back({"Mission", file});
  if (diagnosis.duration_s > 0) rows.back().back() += ", " + duration_text(diagnosis.duration_s);
  for (const auto& file : source.holdouts) rows.push_back({"Held out", file});
  rows.push_back({"Nominal vehicle", source.vehicle.empty() ? "the reference vehicle" : source.vehicle});
  rows.push_back({"Configuration", source.config.empty() ? "the recordings' own" : source.config});
  for (const auto& name : source.excluded) rows.push_back({"Not in the library", name});
  if (diagnosis.field) rows.push_back({"Field of the Earth", gap::text_of(*diagnosis.field)});
  if (diagnosis.bank.missions > 0) {
    rows.push_back({"Bank", bank_text(diagnosis.bank)});
    const auto& bias = diagnosis.gyro_bias_rad_s;
    rows.push_back(
        {"Gyro biases, no cause",
         fmt::format("A-x {}, A-z {}, B-y {}, B-z {}", amount(bias[0] * base::kDegreesPerRadian),
                     amount(bias[1] * base::kDegreesPerRadian), amount(bias[2] * base::kDegreesPerRadian),
                     amount(bias[3] * base::kDegreesPerRadian, "deg/s"))});
  }
  rows.push_back({"Time taken", duration_text(diagnosis.seconds)});
  rows.push_back({"Program", "navcal " NAVCAL_VERSION});
  page.section("Made from");
  page.table({"", ""}, rows);
}

}  // namespace

std::string gap_page(const gap::Diagnosis& diagnosis, const GapSource& source) {
  std::vector<std::string> names;
  for (const auto& file : source.missions) names.push_back(std::filesystem::path(file).filename().string());
  HtmlPage page(fmt::format("Gap between model and {}", fmt::join(names, ", ")));
  append_summary(page, diagnosis, source);
  if (!diagnosis.instruments_alone) append_where(page, diagnosis);
  if (!diagnosis.instruments_alone && diagnosis.verdict != gap::Verdict::no_gap)
    append_causes(page, diagnosis, source);
  append_left_over(page, diagnosis);
  append_residuals(page, diagnosis);
  append_source(page, diagnosis, source);
  return std::move(page).finish();
}

}  // namespace navcal::report

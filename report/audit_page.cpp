// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "report/audit_report.h"
#include "report/audit_words.h"
#include "report/html_page.h"
#include "report/shown_number.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

using analysis::Certainty;
using analysis::Finding;

constexpr std::size_t kFirst = 3;  ///< findings at the top of the page

Figure audit_figure(const Finding& finding) {
  constexpr std::array kInks{SvgPlot::Ink::before, SvgPlot::Ink::after};
  const analysis::AuditPicture& picture = *finding.picture;
  std::vector<double> xs, ys;
  for (const auto& trace : picture.traces) {
    for (const auto& [x, y] : trace.points) {
      xs.push_back(x);
      ys.push_back(y);
    }
  }
  SvgPlot plot(picture.title, {picture.x, whole_range_of(xs)}, {picture.y, whole_range_of(ys)});
  for (std::size_t i = 0; i < picture.traces.size(); ++i) {
    const auto& trace = picture.traces[i];
    std::vector<Point> points;
    for (const auto& [x, y] : trace.points) points.push_back({x, y});
    if (trace.is_line)
      plot.line(kInks.at(i % kInks.size()), trace.name, points);
    else
      plot.points(kInks.at(i % kInks.size()), trace.name, points);
  }
  return {std::string(audit_title(finding)) + ", " + finding.channel, plot.svg(), picture.caption};
}

std::string audit_headline(const Finding& finding) {
  std::string text = fmt::format("{}, {}", audit_title(finding), finding.channel);
  if (const std::string value = audit_value(finding); !value.empty()) text += ": " + value;
  if (const std::string cost = audit_cost(finding); !cost.empty()) text += "; " + cost;
  return text + ". " + finding.sentence;
}

void append_table(HtmlPage& page, std::string_view title, const std::vector<const Finding*>& findings) {
  if (findings.empty()) return;
  page.heading(title);
  std::vector<std::vector<std::string>> rows;
  for (const Finding* finding : findings)
    rows.push_back({std::string(audit_title(*finding)), finding->channel, audit_value(*finding),
                    audit_cost(*finding), finding->sentence, finding->todo});
  page.table({"finding", "sensor", "value (95 %)", "costs", "evidence", "what to do"}, rows);
}

void append_file(HtmlPage& page, const analysis::AuditedFile& file) {
  page.section(file.file.substr(file.file.rfind('/') + 1));
  std::vector<const Finding*> first = audit_findings(file, Certainty::found);
  const auto likely = audit_findings(file, Certainty::likely);
  first.insert(first.end(), likely.begin(), likely.end());
  page.fact(first.empty() ? "good" : "bad", "audit", audit_summary(file));
  for (std::size_t i = 0; i < std::min(first.size(), kFirst); ++i)
    page.fact(first[i]->certainty == Certainty::found ? "bad" : "plain", analysis::name_of(first[i]->certainty),
              audit_headline(*first[i]));
  if (file.is_partial) page.fact("plain", "partial", "Reading was ended before the end of the file.");
  append_table(page, "Found", audit_findings(file, Certainty::found));
  append_table(page, "Likely", likely);
  std::vector<Figure> figures;
  for (const Finding* finding : first) {
    if (finding->picture) figures.push_back(audit_figure(*finding));
  }
  if (!figures.empty()) page.figures(figures);
  append_table(page, "Cannot be said", audit_findings(file, Certainty::cannot_say));
  append_table(page, "Nothing found", audit_findings(file, Certainty::nothing));
  std::vector<std::vector<std::string>> made{{"File", file.file},
                                             {"Length", duration_text(file.duration_s)},
                                             {"Costs", fmt::format("ten minutes at {:.1f} m/s", file.speed_m_s)},
                                             {"Program", "navcal " NAVCAL_VERSION}};
  for (const std::string& remark : file.remarks) made.push_back({"Remark", remark});
  page.table({"", ""}, made);
}

}  // namespace

std::string audit_page(const analysis::Audit& audit) {
  const std::string& first = audit.files.front().file;
  HtmlPage page("Audit of " + first.substr(first.rfind('/') + 1));
  for (const analysis::AuditedFile& file : audit.files) append_file(page, file);
  if (audit.files.size() > 1) {
    page.section("What changed");
    std::vector<std::vector<std::string>> rows;
    for (const auto& change : audit.changes) rows.push_back({change.file, change.sentence});
    if (rows.empty())
      page.paragraph("Nothing changed beyond the intervals.");
    else
      page.table({"log", "change"}, rows);
  }
  return std::move(page).finish();
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "report/audit_report.h"
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
  for (const auto& [name, points] : picture.traces) {
    for (const auto& [x, y] : points) {
      xs.push_back(x);
      ys.push_back(y);
    }
  }
  SvgPlot plot(picture.title, {picture.x, whole_range_of(xs)}, {picture.y, whole_range_of(ys)});
  std::size_t ink = 0;
  for (const auto& [name, points] : picture.traces) {
    std::vector<Point> drawn;
    for (const auto& [x, y] : points) drawn.push_back({x, y});
    plot.points(kInks.at(ink++ % kInks.size()), name, drawn);
  }
  return {fmt::format("{} ({})", finding.title, finding.channel), plot.svg(),
          picture.title + ". " + finding.sentence};
}

void append_file(HtmlPage& page, const analysis::AuditedFile& file) {
  page.section(file.file.substr(file.file.rfind('/') + 1));
  page.fact("plain", "audit", summary_of(file));
  std::size_t told = 0;
  std::vector<Figure> figures;
  for (const Finding& finding : file.findings) {
    const bool is_claim = finding.certainty == Certainty::found || finding.certainty == Certainty::likely;
    if (is_claim && told++ < kFirst)
      page.fact(finding.certainty == Certainty::found ? "bad" : "plain", name_of(finding.certainty),
                headline_of(finding) + ". " + finding.todo);
    if (finding.picture) figures.push_back(audit_figure(finding));
  }
  if (told == 0) page.fact("good", "nothing found", "Nothing that the log tells is wrong.");
  if (!figures.empty()) page.figures(figures);
  for (const Certainty certainty :
       {Certainty::found, Certainty::likely, Certainty::cannot_say, Certainty::nothing}) {
    std::vector<std::vector<std::string>> rows;
    for (const Finding& finding : file.findings) {
      if (finding.certainty != certainty) continue;
      rows.push_back({headline_of(finding), finding.sentence});
      if (certainty != Certainty::nothing) rows.back().push_back(finding.todo);
    }
    if (rows.empty()) continue;
    page.heading(name_of(certainty));
    std::vector<std::string> heads{"looked for", "what the log shows", "what to do"};
    if (certainty <= Certainty::likely) heads.front() = "finding with its 95 % interval and cost";
    if (certainty == Certainty::nothing) heads.pop_back();
    page.table(heads, rows);
  }
  std::vector<std::vector<std::string>> made{
      {"File", file.file}, {"Length", duration_text(file.duration_s)}, {"Program", "navcal " NAVCAL_VERSION}};
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
    for (const auto& change : audit.changes()) rows.push_back({change.file, change.sentence});
    if (rows.empty()) rows.push_back({"", "Nothing changed beyond the intervals."});
    page.table({"log", "change"}, rows);
  }
  return std::move(page).finish();
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include "report/noise_page.h"

#include <algorithm>
#include <vector>

#include "report/html_page.h"
#include "report/noise_figures.h"
#include "report/noise_words.h"
#include "report/shown_number.h"

namespace navcal::report {
namespace {

using analysis::RecordedChannel;
using ChannelList = std::vector<const RecordedChannel*>;

/// Channels of a port that have an Allan deviation, four of one unit at most together.
std::vector<ChannelList> overview_groups(const analysis::NoiseReport& report) {
  constexpr std::size_t kTogether = 4;
  std::vector<ChannelList> groups;
  for (const RecordedChannel& recorded : report.channels) {
    if (recorded.noise.allan.empty()) continue;
    const auto fits = [&](const ChannelList& group) {
      return group.size() < kTogether && group.front()->port == recorded.port &&
             group.front()->unit == recorded.unit;
    };
    const auto group = std::find_if(groups.begin(), groups.end(), fits);
    if (group == groups.end())
      groups.push_back({&recorded});
    else
      group->push_back(&recorded);
  }
  return groups;
}

void append_channel(HtmlPage& page, const RecordedChannel& recorded, const analysis::NoiseReport& report) {
  const auto figures = channel_figures(recorded, report);
  if (figures.empty()) return;
  page.folded_figures(recorded.name(), figures);
}

void append_remarks(HtmlPage& page, const analysis::NoiseReport& report) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& recorded : report.channels) {
    for (const auto& remark : noise_remarks(recorded)) rows.push_back({recorded.name(), remark});
  }
  if (rows.empty()) return;
  page.section("Remarks");
  page.table({"channel", "remark"}, rows);
}

}  // namespace

std::string noise_page(const analysis::NoiseReport& report) {
  HtmlPage page("Noise of " + report.file.substr(report.file.rfind('/') + 1));
  const bool found = !report.quiet.empty();
  page.fact(found ? "good" : "bad", found ? "rest" : "no rest", rest_sentence(report));
  for (const auto& remark : report.remarks) page.fact("plain", "recording", remark);
  std::vector<std::vector<std::string>> rows;
  for (const auto& recorded : report.channels) rows.push_back(noise_row(recorded, kPlusMinus));
  if (found && !rows.empty()) {
    page.section("Channels");
    page.table(noise_heads(), rows);
    page.paragraph(
        "The noise of a reading is one standard deviation, rounding included. White noise is the root of the "
        "two-sided "
        "power density (of a rate: the angle random walk). A value after < is a 95 % limit.");
  }
  std::vector<Figure> overview;
  for (const auto& group : overview_groups(report)) overview.push_back(allan_overview(group));
  if (!overview.empty()) {
    page.section("Allan deviations");
    page.figures(overview);
  }
  page.section("Each channel");
  for (const auto& recorded : report.channels) append_channel(page, recorded, report);
  if (found) append_remarks(page, report);
  page.section("Made from");
  page.table({"", ""}, {{"Recording", report.file},
                        {"Length", duration_text(report.duration_s)},
                        {"Program", "navcal " NAVCAL_VERSION}});
  return std::move(page).finish();
}

}  // namespace navcal::report

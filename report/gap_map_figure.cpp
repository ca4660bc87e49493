// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

#include "report/gap_figures.h"

namespace navcal::report {
namespace {

/// Multiple of the floor at which a shade begins.
constexpr std::array kShades{0.0, 1.5, 3.0, 6.0, 12.0};
constexpr double kMostShown = 999;

double times_the_floor(const gap::WhereEntry& entry) {
  if (!std::isfinite(entry.gap) || entry.gap <= 0) return 0;
  return entry.floor > 0 ? entry.gap / entry.floor : kMostShown + 1;
}

std::size_t shade_of(double times) {
  std::size_t shade = 0;
  while (shade + 1 < kShades.size() && times >= kShades[shade + 1]) ++shade;
  return shade;
}

std::string text_of_cell(double times) {
  if (times < kShades[1]) return {};
  if (times > kMostShown) return fmt::format("> {:.0f}", kMostShown);
  return fmt::format("{:.{}f}", times, times < 9.95 ? 1 : 0);
}

std::vector<std::string> names(const std::vector<gap::WhereEntry>& map, std::string gap::WhereEntry::*which) {
  std::vector<std::string> all;
  for (const auto& entry : map) {
    if (std::ranges::find(all, entry.*which) == all.end()) all.push_back(entry.*which);
  }
  return all;
}

const gap::WhereEntry* entry_of(const std::vector<gap::WhereEntry>& entries, const std::string& channel,
                                const std::string& regime) {
  const auto found = std::ranges::find_if(
      entries, [&](const gap::WhereEntry& entry) { return entry.channel == channel && entry.regime == regime; });
  return found == entries.end() ? nullptr : &*found;
}

void append_cell(std::string& html, const gap::WhereEntry& entry, bool stands_clear) {
  const double times = times_the_floor(entry);
  const std::string about =
      fmt::format("{}, {}: {}; nominal {}; by chance {}", entry.channel, spaced(entry.regime),
                  amount(entry.gap, entry.unit), amount(entry.floor, entry.unit), chance_text(entry.p_value));
  fmt::format_to(std::back_inserter(html), "<td class=\"heat{}{}\" title=\"{}\">{}</td>", shade_of(times),
                 stands_clear ? " clear" : "", escaped(about), escaped(text_of_cell(times)));
}

void append_legend(std::string& html) {
  html += "<div class=\"legend\">";
  for (std::size_t i = 0; i < kShades.size(); ++i) {
    const std::string range = i == 0                    ? fmt::format("below {:g}", kShades[1])
                              : i + 1 == kShades.size() ? fmt::format("from {:g}", kShades[i])
                                                        : fmt::format("{:g} to {:g}", kShades[i], kShades[i + 1]);
    fmt::format_to(std::back_inserter(html), "<span><i class=\"heat{}\"></i>{}</span>", i, range);
  }
  html += "<span><i class=\"heat0 clear\"></i>significant</span></div>\n";
}

}  // namespace

std::optional<Figure> map_figure(const gap::Diagnosis& diagnosis) {
  const auto& map = diagnosis.map;
  if (map.empty()) return std::nullopt;
  const auto channels = names(map, &gap::WhereEntry::channel), regimes = names(map, &gap::WhereEntry::regime);
  std::string html = "<div class=\"scroll\"><table class=\"map\">\n<thead><tr><th></th>";
  for (const std::string& regime : regimes) html += "<th><span>" + escaped(spaced(regime)) + "</span></th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const std::string& channel : channels) {
    html += "<tr><th>" + escaped(channel) + "</th>";
    for (const std::string& regime : regimes) {
      if (const auto* const entry = entry_of(map, channel, regime)) {
        append_cell(html, *entry, entry_of(diagnosis.where, channel, regime) != nullptr);
      } else {
        html += "<td></td>";
      }
    }
    html += "</tr>\n";
  }
  html += "</tbody>\n</table></div>\n";
  append_legend(html);
  return Figure{"Residuals by channel and covariate", std::move(html),
                "The part of each channel's residuals that follows a covariate, as a multiple of that of the "
                "nominal vehicle."};
}

}  // namespace navcal::report

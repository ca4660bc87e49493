// SPDX-License-Identifier: Apache-2.0
// Bars beside names: probabilities of causes, and the share of the gap that closes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "report/gap_figures.h"
#include "report/html_page.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

constexpr std::size_t kMostCauses = 8;

/// A part of the range, in percent of its length, for a style.
std::string placed(Range range, double from, double to) {
  const auto share = [&](double value) {
    return 100 * (std::clamp(value, range.least, range.most) - range.least) / range.length();
  };
  const double left = share(std::min(from, to)), right = share(std::max(from, to));
  return fmt::format("left:{:.1f}%;width:{:.1f}%", left, right - left);
}

void append_part(std::string& html, std::string_view kind, const std::string& place) {
  fmt::format_to(std::back_inserter(html), "<i class=\"{}\" style=\"{}\"></i>", kind, place);
}

void append_row(std::string& html, std::string_view name, const std::string& bar_html, std::string_view value) {
  fmt::format_to(std::back_inserter(html),
                 "<b>{}</b><span class=\"bar\">{}</span><span class=\"value\">{}</span>\n", escaped(name),
                 bar_html, escaped(value));
}

void append_detail(std::string& html, std::string_view text) {
  if (!text.empty()) html += "<span class=\"detail\">" + escaped(text) + "</span>\n";
}

/// Text with no-break spaces.
std::string unbroken(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == ' ' ? std::string("\u00a0") : std::string(1, c);
  return out;
}

/// Display of a cause: part of the verdict, considered beside it, or one of those that explain too little.
enum class Standing { named, considered, unconvincing };

void append_cause(std::string& html, const gap::EffectFinding& effect, Standing standing) {
  const bool named = standing == Standing::named;
  if (standing == Standing::unconvincing) {
    append_row(html, effect.name, "", "explains too little");
  } else {
    const double probability = std::isfinite(effect.probability) ? effect.probability : 0;
    std::string bar;
    append_part(bar, named ? "fill" : "fill weak", placed({0, 1}, 0, probability));
    append_row(html, effect.name, bar, probability_text(effect.probability));
  }
  std::string parameters;
  for (const auto& parameter : effect.parameters) {
    parameters += (parameters.empty() ? "" : ", ") + unbroken(text_of(parameter, kPlusMinus));
  }
  append_detail(html, parameters);
  if (!named) return;
  for (const auto& other : effect.confused_with) append_detail(html, text_of(other));
}

/// Range from none to all, extended if a closure lies outside.
Range range_of_closures(const gap::Gap& gap) {
  constexpr double kFarthest = 0.5;
  Range range{0, 1};
  const auto include_value = [&](double closed) {
    if (!std::isfinite(closed)) return;
    range.least = std::min(range.least, std::max(closed, -kFarthest));
    range.most = std::max(range.most, std::min(closed, 1 + kFarthest));
  };
  const auto include = [&](const gap::Closure& closure) {
    if (closure.closed) include_value(*closure.closed);
    if (!closure.closed_ci) return;
    for (const double end : *closure.closed_ci) include_value(end);
  };
  include(gap.pooled);
  for (const auto& channel : gap.channels) include(channel.closure);
  range.most = std::max(range.most, 1.05);
  return range;
}

void append_closure(std::string& html, std::string_view name, const gap::Closure& closure, std::string_view unit,
                    Range range) {
  std::string bar;
  if (closure.closed && std::isfinite(*closure.closed)) {
    append_part(bar, *closure.closed < 0 ? "fill worse" : "fill", placed(range, 0, *closure.closed));
  }
  for (const double line : {0.0, 1.0}) append_part(bar, "line-at", placed(range, line, line));
  if (closure.closed && closure.closed_ci && std::isfinite(closure.closed_ci->front()) &&
      std::isfinite(closure.closed_ci->back())) {
    append_part(bar, "whisker", placed(range, closure.closed_ci->front(), closure.closed_ci->back()));
  }
  append_row(html, name, bar, closed_text(closure));
  append_detail(html, levels_text(closure, unit, kArrow));
}

}  // namespace

std::optional<Figure> cause_figure(const gap::Diagnosis& diagnosis) {
  const auto& effects = diagnosis.effects;
  const auto is_named = [&](const gap::EffectFinding& candidate) {
    return std::ranges::any_of(effects,
                               [&](const gap::EffectFinding& effect) { return effect.name == candidate.name; });
  };
  std::string html = "<div class=\"ranks\">\n";
  for (const auto& effect : effects) append_cause(html, effect, Standing::named);
  const bool outside = diagnosis.verdict == gap::Verdict::unknown && diagnosis.kind == gap::UnknownKind::outside;
  const Standing standing = outside ? Standing::unconvincing : Standing::considered;
  std::size_t others = 0;
  for (const auto& candidate : diagnosis.candidates) {
    if (!is_named(candidate) && others++ < kMostCauses) append_cause(html, candidate, standing);
  }
  html += "</div>\n";
  if (effects.empty() && others == 0) return std::nullopt;
  return Figure{outside ? "Considered, but not sufficient" : "Causes by probability", std::move(html),
                effects.empty()
                    ? "No cause is named. " + std::string(candidates_heading(diagnosis.kind))
                    : "Blue: the set on which the verdict rests, with standard errors. Grey: considered as well."};
}

std::optional<Figure> closure_figure(const gap::Diagnosis& diagnosis, const GapSource& source) {
  if (diagnosis.effects.empty()) return std::nullopt;
  const gap::Gap& gap = diagnosis.gap;
  const Range range = range_of_closures(gap);
  std::string html = "<div class=\"ranks\">\n";
  append_closure(html, "altogether", gap.pooled, {}, range);
  for (const auto& channel : gap.channels) {
    append_closure(html, channel.channel, channel.closure, channel.unit, range);
  }
  html += "</div>\n";
  return Figure{"How much of the gap closes", std::move(html),
                "From none to all of the gap above the floor, with 95 % intervals, " + judged_on(gap, source) +
                    ". Altogether: power of the whitened residuals; channels: root mean square."};
}

}  // namespace navcal::report

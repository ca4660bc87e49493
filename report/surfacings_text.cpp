// SPDX-License-Identifier: Apache-2.0
#include "report/surfacings_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/durations.h"

namespace navcal::report {
namespace {

/// Value at this share of the sorted values, between neighbours linearly.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

std::string cell(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

std::string cell(const std::optional<std::uint8_t>& count) { return count ? fmt::format("{}", *count) : "-"; }

std::string utc_text(std::int64_t utc_ns) {
  const std::time_t seconds = utc_ns / base::kSecond_ns;
  std::tm time{};
  gmtime_r(&seconds, &time);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02}", time.tm_year + 1900, time.tm_mon + 1, time.tm_mday,
                     time.tm_hour, time.tm_min, time.tm_sec);
}

nlohmann::json json_of(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json json_of(const std::optional<std::uint8_t>& count) {
  return count ? nlohmann::json(*count) : nlohmann::json();
}

nlohmann::json json_of(const analysis::RecordedSurfacing& found) {
  const auto& surfacing = found.surfacing;
  return {{"file", found.file},
          {"time", static_cast<double>(found.first_fix_utc_ns) * 1e-9},
          {"without_fix_s", json_of(surfacing.without_fix_s())},
          {"submerged_s", json_of(surfacing.submerged_s())},
          {"deepest_m", json_of(surfacing.deepest_m)},
          {"ttff_s", json_of(surfacing.time_to_first_fix_s())},
          {"visible", json_of(surfacing.visible)},
          {"tracked", json_of(surfacing.tracked)},
          {"dop", json_of(surfacing.dop)},
          {"distance_m", json_of(found.distance_m)},
          {"error_m", json_of(found.error_m)},
          {"std_m", json_of(found.std_m)},
          {"error_uncalibrated_m", json_of(found.error_uncalibrated_m)}};
}

}  // namespace

SurfacingStatistics statistics_of(const std::vector<analysis::RecordedSurfacing>& surfacings) {
  SurfacingStatistics statistics;
  statistics.count = surfacings.size();
  std::vector<double> times_s;
  double squares = 0;
  for (const auto& found : surfacings) {
    if (const auto time_s = found.surfacing.time_to_first_fix_s()) times_s.push_back(*time_s);
    if (!found.error_m || !found.std_m || *found.std_m <= 0) continue;
    ++statistics.with_error;
    squares += std::pow(*found.error_m / *found.std_m, 2);
  }
  statistics.with_ttff = times_s.size();
  if (!times_s.empty()) {
    std::sort(times_s.begin(), times_s.end());
    statistics.least_s = times_s.front();
    statistics.longest_s = times_s.back();
    statistics.median_s = quantile(times_s, 0.5);
    statistics.p90_s = quantile(times_s, 0.9);
    statistics.mean_s = std::accumulate(times_s.begin(), times_s.end(), 0.0) / static_cast<double>(times_s.size());
  }
  if (statistics.with_error > 0)
    statistics.error_over_std = std::sqrt(squares / static_cast<double>(statistics.with_error));
  return statistics;
}

std::vector<std::string> surfacing_heads() {
  return {"first fix, UTC", "no fix, s", "under water, s", "deepest, m", "TTFF, s",
          "satellites",     "DOP",       "way, m",         "error, m",   "stated, m"};
}

std::vector<std::string> surfacing_row(const analysis::RecordedSurfacing& found) {
  const auto& surfacing = found.surfacing;
  return {utc_text(found.first_fix_utc_ns),
          cell(surfacing.without_fix_s(), 0),
          cell(surfacing.submerged_s(), 0),
          cell(surfacing.deepest_m, 1),
          cell(surfacing.time_to_first_fix_s(), 1),
          cell(surfacing.tracked) + "/" + cell(surfacing.visible),
          cell(surfacing.dop, 1),
          cell(found.distance_m, 0),
          cell(found.error_m, 1),
          cell(found.std_m, 1)};
}

std::vector<std::string> surfacing_sentences(const SurfacingStatistics& statistics) {
  std::vector<std::string> sentences;
  sentences.push_back(fmt::format("{} surfacings.", statistics.count));
  if (statistics.count > statistics.with_ttff) {
    sentences.push_back(
        fmt::format("The time of surfacing is not known for {}: there is no reading of a depth gauge.",
                    statistics.count - statistics.with_ttff));
  }
  if (statistics.median_s) {
    sentences.push_back(fmt::format(
        "Time to first fix: median {:.1f} s, mean {:.1f} s, 90 % within {:.1f} s, from {:.1f} to {:.1f} s.",
        *statistics.median_s, *statistics.mean_s, *statistics.p90_s, *statistics.least_s, *statistics.longest_s));
  }
  if (statistics.error_over_std) {
    sentences.push_back(
        fmt::format("Error of the dead reckoning over its stated standard error: {:.2f} (root mean square of {}).",
                    *statistics.error_over_std, statistics.with_error));
  }
  return sentences;
}

std::string surfacings_text(const std::vector<analysis::RecordedSurfacing>& surfacings) {
  std::vector<std::vector<std::string>> rows{surfacing_heads()};
  for (const auto& found : surfacings) rows.push_back(surfacing_row(found));
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string out;
  for (const auto& row : rows) {
    if (surfacings.empty()) break;
    for (std::size_t i = 0; i < row.size(); ++i)
      out += fmt::format("{:>{}}{}", row[i], widths[i], i + 1 < row.size() ? "  " : "\n");
  }
  for (const auto& sentence : surfacing_sentences(statistics_of(surfacings))) out += sentence + '\n';
  return out;
}

std::string surfacings_json(const std::vector<analysis::RecordedSurfacing>& surfacings,
                            const std::vector<std::string>& files) {
  auto list = nlohmann::json::array();
  for (const auto& found : surfacings) list.push_back(json_of(found));
  const SurfacingStatistics statistics = statistics_of(surfacings);
  const nlohmann::json json{{"class", "SURFACINGS"},
                            {"files", files},
                            {"surfacings", list},
                            {"statistics",
                             {{"count", statistics.count},
                              {"with_ttff", statistics.with_ttff},
                              {"ttff_least_s", json_of(statistics.least_s)},
                              {"ttff_median_s", json_of(statistics.median_s)},
                              {"ttff_mean_s", json_of(statistics.mean_s)},
                              {"ttff_p90_s", json_of(statistics.p90_s)},
                              {"ttff_longest_s", json_of(statistics.longest_s)},
                              {"with_error", statistics.with_error},
                              {"error_over_std", json_of(statistics.error_over_std)}}}};
  return json.dump() + '\n';
}

}  // namespace navcal::report

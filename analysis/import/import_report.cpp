// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/import_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "base/enum_name.h"
#include "base/printable.h"
#include "record/json/put_members.h"

namespace navcal::analysis {
namespace {

std::string words_of_utc(const ImportReport& report) {
  const auto start_s = static_cast<std::time_t>(report.start_utc_ns / 1'000'000'000);
  const std::string start = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(start_s));
  switch (report.utc) {
    case ImportReport::Utc::of_file: return fmt::format("begins {} (times of the file are UTC)", start);
    case ImportReport::Utc::of_gps: return fmt::format("begins {} (UTC by GPS)", start);
    case ImportReport::Utc::unknown: break;
  }
  return "no UTC: times count from boot, which is set to 2000-01-01T00:00:00Z";
}

/// A row of the table, and its count of messages.
using CountedRow = std::pair<std::uint64_t, std::string>;

/// Those with most messages where there are too many to read.
void append_rows(std::string& out, std::vector<CountedRow> rows) {
  constexpr std::size_t kMostRows = 40;
  const std::size_t shown = std::min(rows.size(), kMostRows);
  if (shown < rows.size()) std::ranges::stable_sort(rows, std::greater(), &CountedRow::first);
  for (std::size_t i = 0; i < shown; ++i) out += rows[i].second;
  if (shown < rows.size())
    out += fmt::format("and {} more of at most {} each; --json has all\n", rows.size() - shown, rows[shown].first);
}

std::string_view key_of(ImportReport::Utc utc) {
  return base::enum_name<ImportReport::Utc::unknown>(utc, {"file", "gps", "none"});
}

}  // namespace

double ImportReport::Taken::rate_Hz() const {
  return messages < 2 || last_ns <= first_ns
             ? 0
             : static_cast<double>(messages - 1) / (static_cast<double>(last_ns - first_ns) * 1e-9);
}

std::string to_text(const ImportReport& report) {
  std::size_t width = 16;
  for (const auto& [of, taken] : report.taken) width = std::max(width, of.first.size());
  for (const auto& [name, count] : report.left) width = std::max(width, name.size());
  std::string out =
      fmt::format("{}: {}, {} bytes, {:.3f} s\n{}\n\n", base::printable(report.input), report.format, report.bytes,
                  static_cast<double>(report.duration_ns) * 1e-9, words_of_utc(report));
  out += fmt::format("{:<{}}  {:>9}  {:>9}  {}\n", "taken", width, "messages", "rate (Hz)", "port");
  std::vector<CountedRow> taken_rows, left_rows;
  for (const auto& [of, taken] : report.taken)
    taken_rows.emplace_back(taken.messages, fmt::format("{:<{}}  {:>9}  {:>9.2f}  {}\n", base::printable(of.first),
                                                        width, taken.messages, taken.rate_Hz(), of.second));
  append_rows(out, std::move(taken_rows));
  if (report.taken.empty()) out += "nothing\n";
  if (!report.left.empty()) out += fmt::format("\n{:<{}}  {:>9}\n", "left", width, "messages");
  for (const auto& [name, count] : report.left)
    left_rows.emplace_back(count, fmt::format("{:<{}}  {:>9}\n", base::printable(name), width, count));
  append_rows(out, std::move(left_rows));
  if (report.damaged_bytes > 0) out += fmt::format("\n{} damaged bytes were passed over\n", report.damaged_bytes);
  if (report.cut_at)
    out += fmt::format("\nthe file is cut: its last record, at byte {}, is not whole\n", *report.cut_at);
  return out;
}

std::string to_json(const ImportReport& report) {
  using Json = nlohmann::ordered_json;
  Json json{{"class", "IMPORT"}, {"file", report.input}};
  NAVCAL_PUT_MEMBERS(json, report, output, format, bytes);
  json["utc"] = key_of(report.utc);
  json["start"] = static_cast<double>(report.start_utc_ns) * 1e-9;
  json["duration"] = static_cast<double>(report.duration_ns) * 1e-9;
  Json& taken_ones = json["taken"] = Json::array();
  for (const auto& [of, taken] : report.taken)
    taken_ones.push_back({{"class", "TAKEN"},
                          {"message", of.first},
                          {"port", of.second},
                          {"count", taken.messages},
                          {"samples", taken.samples},
                          {"rate_Hz", taken.rate_Hz()}});
  Json& left = json["left"] = Json::array();
  for (const auto& [name, count] : report.left)
    left.push_back({{"class", "LEFT"}, {"message", name}, {"count", count}});
  NAVCAL_PUT_MEMBERS(json, report, refused, damaged_bytes, cut_at, remarks);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace navcal::analysis

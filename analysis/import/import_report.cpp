// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/import_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/printable.h"
#include "record/json/json_object.h"

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

std::string_view key_of(ImportReport::Utc utc) {
  switch (utc) {
    case ImportReport::Utc::of_file: return "file";
    case ImportReport::Utc::of_gps: return "gps";
    case ImportReport::Utc::unknown: break;
  }
  return "none";
}

std::string json_of_taken(const ImportReport& report) {
  std::string out = "[";
  for (const auto& [of, taken] : report.taken) {
    if (out.size() > 1) out += ',';
    record::JsonObject json(out, "TAKEN");
    json.text("message", of.first);
    json.text("port", of.second);
    json.integer("count", static_cast<std::int64_t>(taken.messages));
    json.integer("samples", static_cast<std::int64_t>(taken.samples));
    json.number("rate_Hz", taken.rate_Hz());
  }
  return out + "]";
}

std::string json_of_left(const ImportReport& report) {
  std::string out = "[";
  for (const auto& [name, count] : report.left) {
    if (out.size() > 1) out += ',';
    record::JsonObject json(out, "LEFT");
    json.text("message", name);
    json.integer("count", static_cast<std::int64_t>(count));
  }
  return out + "]";
}

std::string json_of_remarks(const ImportReport& report) {
  std::string out = "[";
  for (const std::string& remark : report.remarks) {
    std::string object;
    { record::JsonObject(object, "x").text("r", remark); }
    constexpr std::string_view kHead = R"({"class":"x","r":)";
    if (out.size() > 1) out += ',';
    out.append(object, kHead.size(), object.size() - kHead.size() - 1);
  }
  return out + "]";
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
  for (const auto& [of, taken] : report.taken)
    out += fmt::format("{:<{}}  {:>9}  {:>9.2f}  {}\n", base::printable(of.first), width, taken.messages,
                       taken.rate_Hz(), of.second);
  if (report.taken.empty()) out += "nothing\n";
  if (!report.left.empty()) out += fmt::format("\n{:<{}}  {:>9}\n", "left", width, "messages");
  for (const auto& [name, count] : report.left)
    out += fmt::format("{:<{}}  {:>9}\n", base::printable(name), width, count);
  if (report.damaged_bytes > 0) out += fmt::format("\n{} damaged bytes were passed over\n", report.damaged_bytes);
  if (report.cut_at)
    out += fmt::format("\nthe file is cut: its last record, at byte {}, is not whole\n", *report.cut_at);
  return out;
}

std::string to_json(const ImportReport& report) {
  std::string out;
  {
    record::JsonObject json(out, "IMPORT");
    json.text("file", report.input);
    json.text("output", report.output);
    json.text("format", report.format);
    json.integer("bytes", static_cast<std::int64_t>(report.bytes));
    json.text("utc", key_of(report.utc));
    json.seconds("start", report.start_utc_ns);
    json.seconds("duration", report.duration_ns);
    json.raw("taken", json_of_taken(report));
    json.raw("left", json_of_left(report));
    json.integer("refused", static_cast<std::int64_t>(report.refused));
    json.integer("damaged_bytes", static_cast<std::int64_t>(report.damaged_bytes));
    if (report.cut_at) {
      json.integer("cut_at", static_cast<std::int64_t>(*report.cut_at));
    } else {
      json.null("cut_at");
    }
    json.raw("remarks", json_of_remarks(report));
  }
  return out + "\n";
}

}  // namespace navcal::analysis

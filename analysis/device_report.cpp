// SPDX-License-Identifier: Apache-2.0
// What `navcal devices check` prints.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/device_check.h"

namespace navcal::analysis {
namespace {

std::string in_json(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += fmt::format("\\{}", c);
    } else if (c >= ' ' && c < 0x7F) {
      out += c;
    } else {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    }
  }
  return out + '"';
}

std::string field_line(const FieldFinding& field, std::size_t width) {
  const std::string unit = field.unit.empty() ? "" : " " + field.unit;
  std::string out = fmt::format("    {:<{}}  ", field.name, width);
  if (field.values == 0) return out + "no value\n";
  out += field.changes == 0 ? fmt::format("{:g}{}, always", field.low, unit)
                            : fmt::format("{:g} to {:g}{}, mean {:g}", field.low, field.high, unit, field.mean);
  if (field.absent > 0) out += fmt::format("; absent in {} frames", field.absent);
  if (field.impossible > 0) out += fmt::format("; {} values cannot be", field.impossible);
  return out + '\n';
}

std::string kind_lines(const KindFinding& kind) {
  std::string out = fmt::format("\n{}: {} frames", kind.id.view(), kind.frames);
  if (kind.rate_Hz) out += fmt::format(", {:.4g} a second", *kind.rate_Hz);
  if (kind.impossible > 0) out += fmt::format(", {} with a value that cannot be", kind.impossible);
  out += '\n';
  std::size_t width = 0;
  for (const FieldFinding& field : kind.fields) width = std::max(width, field.name.size());
  for (const FieldFinding& field : kind.fields) out += field_line(field, width);
  return out;
}

}  // namespace

std::string hex_of(std::string_view bytes) {
  std::string out;
  for (const char byte : bytes)
    out += fmt::format("{}{:02X}", out.empty() ? "" : " ", static_cast<unsigned char>(byte));
  return out;
}

std::string to_text(const DeviceFindings& findings) {
  const auto& counters = findings.summary.counters;
  std::string out = fmt::format(
      "{} bytes: {} in {} frames, {} skipped, {} in an incomplete frame at the end; {} bad checksums\n",
      counters.bytes, counters.framed_bytes, counters.frames, findings.summary.skipped_bytes(),
      findings.summary.incomplete_bytes, counters.bad_checksum);
  for (const SkippedRun& run : findings.skipped)
    out += fmt::format("  skipped {} bytes at {}: {}{}\n", run.length, run.offset, hex_of(run.first_bytes),
                       run.length > run.first_bytes.size() ? " ..." : "");
  if (findings.skipped_runs > findings.skipped.size())
    out += fmt::format("  and at {} more places\n", findings.skipped_runs - findings.skipped.size());
  for (const KindFinding& kind : findings.kinds) out += kind_lines(kind);
  if (!findings.warnings.empty()) out += '\n';
  for (const std::string& warning : findings.warnings) out += "warning: " + warning + '\n';
  return out;
}

std::string to_json(const DeviceFindings& findings) {
  std::string out;
  for (const KindFinding& kind : findings.kinds) {
    out += fmt::format(R"({{"class":"KIND","id":{},"frames":{},"out_of_range":{},"rate_Hz":{},"fields":[)",
                       in_json(kind.id.view()), kind.frames, kind.impossible,
                       kind.rate_Hz ? fmt::format("{}", *kind.rate_Hz) : "null");
    for (std::size_t i = 0; i < kind.fields.size(); ++i) {
      const FieldFinding& field = kind.fields[i];
      const auto number = [&](double value) { return field.values > 0 ? fmt::format("{}", value) : "null"; };
      out += fmt::format(
          R"({}{{"name":{},"unit":{},"values":{},"absent":{},"out_of_range":{},"changes":{},"low":{},"high":{},"mean":{}}})",
          i > 0 ? "," : "", in_json(field.name), in_json(field.unit), field.values, field.absent, field.impossible,
          field.changes, number(field.low), number(field.high), number(field.mean));
    }
    out += "]}\n";
  }
  for (const std::string& warning : findings.warnings)
    out += fmt::format("{{\"class\":\"WARNING\",\"text\":{}}}\n", in_json(warning));
  const auto& counters = findings.summary.counters;
  out += fmt::format(R"({{"class":"SUMMARY","bytes":{},"frames":{{)", counters.bytes);
  for (std::size_t i = 0; i < findings.kinds.size(); ++i)
    out +=
        fmt::format("{}{}:{}", i > 0 ? "," : "", in_json(findings.kinds[i].id.view()), findings.kinds[i].frames);
  out +=
      fmt::format(R"(}},"bad_checksum":{},"framed_bytes":{},"skipped_bytes":{},"incomplete_bytes":{},"skipped":[)",
                  counters.bad_checksum, counters.framed_bytes, findings.summary.skipped_bytes(),
                  findings.summary.incomplete_bytes);
  for (std::size_t i = 0; i < findings.skipped.size(); ++i)
    out += fmt::format(R"({}{{"offset":{},"length":{},"first_bytes":"{}"}})", i > 0 ? "," : "",
                       findings.skipped[i].offset, findings.skipped[i].length,
                       hex_of(findings.skipped[i].first_bytes));
  return out + "]}\n";
}

}  // namespace navcal::analysis

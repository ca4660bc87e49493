// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_summary.h"

#include <fmt/format.h>

namespace navcal::analysis {

void write_json(base::Output& output, const DecodeSummary& summary) {
  const auto& counters = summary.counters;
  output.append(fmt::format(R"({{"class":"SUMMARY","bytes":{},"frames":{{)", counters.bytes));
  bool first = true;
  for (const auto& [id, count] : summary.frames) {
    output.append(fmt::format(R"({}"{}":{})", first ? "" : ",", id.view(), count));
    first = false;
  }
  output.append(fmt::format(R"(}},"bad_checksum":{},"framed_bytes":{},"skipped_bytes":{},"incomplete_bytes":{}}})"
                            "\n",
                            counters.bad_checksum, counters.framed_bytes, summary.skipped_bytes(),
                            summary.incomplete_bytes));
}

void write_text(base::Output& output, const DecodeSummary& summary) {
  const auto& counters = summary.counters;
  output.append(fmt::format("\n{} frames", counters.frames));
  const char* separator = ": ";
  for (const auto& [id, count] : summary.frames) {
    output.append(fmt::format("{}{} {}", separator, id.view(), count));
    separator = ", ";
  }
  output.append(fmt::format("\n{} bytes: {} in frames, {} skipped, {} in an incomplete frame at the end\n",
                            counters.bytes, counters.framed_bytes, summary.skipped_bytes(),
                            summary.incomplete_bytes));
  if (summary.undecoded.total() > 0)
    output.append(fmt::format("frames without a decoder: {}\n", summary.undecoded.words()));
  if (counters.bad_checksum > 0) output.append(fmt::format("{} bad checksums\n", counters.bad_checksum));
}

}  // namespace navcal::analysis

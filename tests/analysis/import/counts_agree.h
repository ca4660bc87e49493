// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "analysis/import/import_log.h"
#include "record/log/log_reader.h"
#include "record/recording.h"
#include "tests/analysis/import/recording_sink.h"
#include "tests/support/temporary_folder.h"

namespace navcal::analysis::testing {

using PortCounts = std::map<std::string, std::uint64_t>;

/// Samples in, samples written and samples left, port by port: what the reader finds, what the report counts, and
/// what is read back from the log that was written. Returns the samples of the log.
inline PortCounts expect_counts_agree(const std::string& format, const std::string& bytes,
                                      const std::string& map = "") {
  const test::TemporaryFolder folder;
  const auto input = folder / "input", log = folder / "log.mcap";
  std::ofstream(input, std::ios::binary) << bytes;
  ImportOptions options;
  options.format = format;
  options.map = map;
  const ImportReport report = import_log(input, log, options, [](double) {});
  RecordingSink sink;
  (void)import_format_named(format)->read(bytes, options, sink);
  PortCounts given, counted, written;
  for (const auto& sample : sink.samples) ++given[sample.port];
  for (const auto& [of, taken] : report.taken) counted[of.second] += taken.samples;
  EXPECT_EQ(given, counted) << "in, and taken by the report";
  record::LogReader reader(record::open_file(log), log.string());
  while (const auto message = reader.next()) {
    if (reader.channels().at(message->channel).raw) continue;
    const auto json = nlohmann::json::parse(message->data);
    const std::string port = json.value("device", "");
    if (given.count(port) > 0) ++written[port];
  }
  PortCounts and_left = written;
  std::uint64_t refused = 0;
  for (const auto& [port, count] : given) {
    const auto left = report.left.find("sample of " + port + " (no value, or one out of range)");
    if (left == report.left.end()) continue;
    and_left[port] += left->second;
    refused += left->second;
  }
  EXPECT_EQ(and_left, given) << "written and left, and in";
  EXPECT_EQ(refused, report.refused);
  return written;
}

}  // namespace navcal::analysis::testing

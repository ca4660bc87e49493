// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "analysis/import/import_sink.h"

namespace navcal::analysis::testing {

/// Keeps all that a reader finds.
class RecordingSink : public ImportSink {
 public:
  struct Found {
    std::string message, port;
    std::int64_t time_ns = 0;
    std::optional<std::int64_t> utc_ns;
    nlohmann::json line;
  };

  void sample(const ImportedSample& sample, protocols::samples_line::LineWriter& line) override {
    samples.push_back({std::string(sample.message), std::string(sample.port), sample.time_ns, sample.utc_ns,
                       nlohmann::json::parse(line.finish())});
  }
  void left(std::string_view message) override { ++left_counts[std::string(message)]; }
  void utc(std::int64_t time_ns, std::int64_t utc_ns) override { utcs.emplace_back(time_ns, utc_ns); }
  void progress(std::uint64_t done) override { newest_progress = done; }

  [[nodiscard]] std::vector<Found> of_port(std::string_view port) const {
    std::vector<Found> found;
    for (const Found& sample : samples) {
      if (sample.port == port) found.push_back(sample);
    }
    return found;
  }

  std::vector<Found> samples;
  std::map<std::string, int> left_counts;
  std::vector<std::pair<std::int64_t, std::int64_t>> utcs;
  std::uint64_t newest_progress = 0;
};

inline void expect_vector(const nlohmann::json& found, double x, double y, double z, double tolerance = 1e-9) {
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0].get<double>(), x, tolerance);
  EXPECT_NEAR(found[1].get<double>(), y, tolerance);
  EXPECT_NEAR(found[2].get<double>(), z, tolerance);
}

/// Reads the file cut at every byte, and with each of its bytes damaged: no crash, and never more samples than in
/// the whole file. A cut within a record is reported at a byte of the file.
template <class Read>
void expect_robust(const std::string& file, Read read, std::size_t step = 1) {
  RecordingSink whole;
  const ImportFindings findings = read(file, whole);
  EXPECT_FALSE(findings.cut_at);
  EXPECT_EQ(findings.damaged_bytes, 0U);
  EXPECT_FALSE(whole.samples.empty());
  std::size_t before = 0;
  for (std::size_t length = 0; length < file.size(); length += step) {
    RecordingSink sink;
    const auto cut = read(file.substr(0, length), sink);
    EXPECT_GE(sink.samples.size(), before) << length;
    EXPECT_LE(sink.samples.size(), whole.samples.size()) << length;
    if (cut.cut_at) {
      EXPECT_LE(*cut.cut_at, length);
    }
    before = sink.samples.size();
  }
  for (std::size_t i = 0; i < file.size(); i += step) {
    for (const unsigned flip : {0x01U, 0x80U, 0xFFU}) {
      std::string damaged = file;
      damaged[i] = static_cast<char>(static_cast<unsigned char>(damaged[i]) ^ flip);
      RecordingSink sink;
      (void)read(damaged, sink);
    }
  }
}

template <class T>
void append_number(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

template <class T>
void append_all(std::string& out, std::initializer_list<T> values) {
  for (const T value : values) append_number(out, value);
}

}  // namespace navcal::analysis::testing

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "analysis/import/import_sink.h"
#include "protocols/samples_line.h"
#include "tests/fuzz/stream_invariants.h"

namespace navcal::fuzz {

/// Requires that every line is one of the protocol `samples`, whatever the file is.
class CheckingSink final : public analysis::ImportSink {
 public:
  void sample(const analysis::ImportedSample& sample, protocols::samples_line::LineWriter& line) override {
    require(!sample.port.empty() && !sample.message.empty());
    const std::string text = line.seconds("time", sample.time_ns).finish();
    const auto* const first = reinterpret_cast<const std::uint8_t*>(text.data());
    const auto scan = protocols::samples_line::Scanner::scan(first, first + text.size());
    require(scan.kind == protocols::Scan::Kind::frame && scan.length == text.size());
    require(protocols::samples_line::Object::parse({first, text.size()}).has_value());
  }
  void left(std::string_view message) override { require(!message.empty()); }
  void utc(std::int64_t /*time_ns*/, std::int64_t /*utc_ns*/) override {}
  void progress(std::uint64_t /*done*/) override {}
};

inline void require_within(const analysis::ImportFindings& findings, std::size_t size) {
  require(!findings.cut_at || *findings.cut_at <= size);
  require(findings.damaged_bytes <= size);
}

}  // namespace navcal::fuzz

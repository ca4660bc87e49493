// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>

#include "base/output.h"
#include "pipeline/pipeline.h"
#include "protocols/frame.h"

namespace navcal::analysis {

/// Composition of a stream: bytes = framed + skipped + incomplete.
struct DecodeSummary {
  protocols::Counters counters;
  /// Behind the last frame, from where a frame began that the end of the input cut.
  std::uint64_t incomplete_bytes = 0;
  std::map<protocols::FrameId, std::uint64_t> frames;
  pipeline::UnusedFrames undecoded;

  [[nodiscard]] std::uint64_t skipped_bytes() const { return counters.skipped_bytes - incomplete_bytes; }
};

/// The SUMMARY line of docs/cli.md.
void write_json(base::Output& output, const DecodeSummary& summary);
/// The same for people.
void write_text(base::Output& output, const DecodeSummary& summary);

}  // namespace navcal::analysis

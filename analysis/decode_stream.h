// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "analysis/decode_summary.h"
#include "protocols/stream_parser.h"

namespace navcal::analysis {

/// Runs the frames of a whole stream through `sink(const Frame&)`. `next()` gives the bytes, piece by piece, an
/// empty piece at the end.
template <protocols::Scanner S, class Next, class Sink>
DecodeSummary decode_stream(Next&& next, Sink&& sink, S scanner = {}) {
  DecodeSummary summary;
  protocols::StreamParser<S> parser(std::move(scanner));
  protocols::FrameId recent;
  std::uint64_t* count = nullptr;  // of `recent`: frames of one kind often follow each other
  const auto counting = [&](const protocols::Frame& frame) {
    if (count == nullptr || frame.id != recent) {
      recent = frame.id;
      count = &summary.frames[recent];
    }
    ++*count;
    sink(frame);
  };

  for (protocols::Bytes bytes = next(); !bytes.empty(); bytes = next()) parser.feed(bytes, counting);

  // Nothing more will come, but a frame that was cut short may hide whole ones behind it. What stands behind the
  // last of them from where a frame could still have begun is incomplete; the parser will have counted it as
  // skipped.
  std::uint64_t unfinished_from = parser.position();
  while (parser.held() > 0) {
    const std::uint64_t frames = parser.counters().frames;
    parser.silence(counting);
    if (parser.counters().frames != frames) unfinished_from = parser.position();
  }
  summary.counters = parser.counters();
  summary.incomplete_bytes = summary.counters.bytes - unfinished_from;
  return summary;
}

}  // namespace navcal::analysis

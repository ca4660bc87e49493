// SPDX-License-Identifier: Apache-2.0
#include "pipeline/arrival_track.h"

#include <algorithm>
#include <limits>

namespace navcal::pipeline {

ArrivalTrack::Frame ArrivalTrack::locate(std::uint64_t offset, std::uint64_t end) const {
  Frame frame;
  frame.start_ns = std::numeric_limits<std::int64_t>::max();
  const std::uint64_t known = std::min<std::uint64_t>(count_, kReads);
  for (std::uint64_t i = 1; i <= known; ++i) {  // newest first
    const Read& read = reads_[(count_ - i) % kReads];
    if (read.end_offset <= offset) break;  // older than the frame
    if (read.end_offset >= end) {          // brought its last byte, unless an older one did
      frame.arrival_ns = read.arrival_ns;
      frame.backlog = read.end_offset > end;
    }
    const auto bytes = static_cast<std::int64_t>(read.end_offset - offset);
    frame.start_ns = std::min(frame.start_ns, read.arrival_ns - bytes * byte_ns_);
  }
  return frame;
}

}  // namespace navcal::pipeline

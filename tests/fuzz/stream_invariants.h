// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "protocols/stream_parser.h"

// Invariants of every stream parser for any bytes and any division into reads. The first byte of an input seeds
// the division, so that the fuzzer can vary it too.
namespace navcal::fuzz {

inline void require(bool condition) {
  if (!condition) std::abort();
}

struct Found {
  protocols::FrameId id;
  std::uint64_t offset = 0;
  std::size_t length = 0;
  bool operator==(const Found&) const = default;
};

template <protocols::Scanner S>
void require_accounts(const protocols::StreamParser<S>& parser, std::uint64_t fed) {
  const auto& c = parser.counters();
  require(c.bytes == fed);
  require(c.bytes == c.framed_bytes + c.skipped_bytes + parser.held());
  require(parser.position() == c.framed_bytes + c.skipped_bytes);
  require((parser.missing() == 0) == (parser.held() == 0));
  require(parser.held() + parser.missing() <= S::kMaxFrameLength);
}

/// A frame fed by itself is the same frame.
template <protocols::Scanner S>
void require_same_alone(const protocols::Frame& frame) {
  protocols::StreamParser<S> parser;
  parser.feed(frame.bytes, [&](const protocols::Frame& again) {
    require(again.id == frame.id && again.offset == 0 && again.bytes.size() == frame.bytes.size());
  });
  require(parser.counters().frames == 1 && parser.held() == 0);
}

/// `use(frame)` is called for every frame and must not crash.
template <protocols::Scanner S, class Use>
void check_stream(protocols::Bytes input, Use&& use, const S& scanner = {}) {
  if (input.empty()) return;
  std::uint32_t state = input[0] + 1U;
  const protocols::Bytes stream = input.subspan(1);
  const auto next_length = [&state](std::size_t limit) {
    state = state * 1664525U + 1013904223U;
    return limit == 0 ? 0 : (state >> 16) % (limit + 1);
  };

  // A frame is the bytes of the stream at its offset, however it came together.
  const auto found = [stream](const protocols::Frame& frame) {
    require(frame.end() <= stream.size());
    require(std::equal(frame.bytes.begin(), frame.bytes.end(),
                       stream.begin() + static_cast<std::ptrdiff_t>(frame.offset)));
    return Found{frame.id, frame.offset, frame.bytes.size()};
  };

  std::vector<Found> whole;
  protocols::StreamParser<S> at_once(scanner);
  at_once.feed(stream, [&](const protocols::Frame& frame) {
    whole.push_back(found(frame));
    use(frame);
  });
  require_accounts(at_once, stream.size());

  std::vector<Found> cut;
  protocols::StreamParser<S> in_pieces(scanner);
  std::size_t fed = 0;
  bool nothing = false;  // was the piece before; two in a row could go on for ever
  while (fed < stream.size()) {
    const std::size_t most = std::min<std::size_t>(stream.size() - fed, 1U + input[0]);
    const std::size_t length = nothing ? 1 + next_length(most - 1) : next_length(most);
    in_pieces.feed(stream.subspan(fed, length),
                   [&](const protocols::Frame& frame) { cut.push_back(found(frame)); });
    fed += length;
    require_accounts(in_pieces, fed);
    nothing = length == 0;
  }
  require(cut == whole);
  require(in_pieces.counters().bad_checksum == at_once.counters().bad_checksum);
  require(in_pieces.held() == at_once.held() && in_pieces.missing() == at_once.missing());

  // Silences in between may produce other frames, but each byte still lies in one place, and all held bytes can be
  // given up.
  protocols::StreamParser<S> with_silences(scanner);
  std::uint64_t end = 0;
  const auto in_order = [&](const protocols::Frame& frame) {
    require(frame.offset >= end);
    end = frame.end();
    use(frame);
  };
  for (fed = 0; fed < stream.size();) {
    const std::size_t length = std::min<std::size_t>(stream.size() - fed, 1 + next_length(40));
    with_silences.feed(stream.subspan(fed, length), in_order);
    fed += length;
    if (next_length(3) == 0) with_silences.silence(in_order);
    require_accounts(with_silences, fed);
  }
  while (with_silences.held() > 0) with_silences.silence(in_order);
  require_accounts(with_silences, stream.size());
}

}  // namespace navcal::fuzz

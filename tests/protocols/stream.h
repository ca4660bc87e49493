// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <random>
#include <utility>
#include <vector>

#include "protocols/stream_parser.h"

// Helpers shared by the tests of all stream parsers: running a parser over a stream divided in any way, and
// streams for it.
namespace navcal::protocols::test {

using Buffer = std::vector<std::uint8_t>;
using Random = std::mt19937_64;

/// A number in [0, n).
inline std::size_t below(Random& random, std::size_t n) { return static_cast<std::size_t>(random() % n); }

struct Seen {
  FrameId id;
  std::uint64_t offset = 0;
  Buffer bytes;
  bool operator==(const Seen&) const = default;
};

/// All that can be observed of a parser after a stream.
struct Outcome {
  std::vector<Seen> frames;
  std::uint64_t bytes = 0, frame_count = 0, bad_checksum = 0, framed_bytes = 0, skipped_bytes = 0;
  std::uint64_t position = 0;
  std::size_t held = 0, missing = 0;
  bool operator==(const Outcome&) const = default;
};

/// A parser and what it has handed over.
template <Scanner S>
class Run {
 public:
  Run() = default;
  explicit Run(S scanner) : parser_(std::move(scanner)) {}

  void feed(Bytes bytes) { parser_.feed(bytes, sink()); }
  void silence() { parser_.silence(sink()); }
  [[nodiscard]] const StreamParser<S>& parser() const { return parser_; }
  [[nodiscard]] const std::vector<Seen>& frames() const { return frames_; }
  [[nodiscard]] bool all_bytes_accounted_for() const {
    const Counters& c = parser_.counters();
    return c.bytes == c.framed_bytes + c.skipped_bytes + parser_.held() &&
           parser_.position() == c.framed_bytes + c.skipped_bytes;
  }
  [[nodiscard]] Outcome outcome() const {
    const Counters& c = parser_.counters();
    return {frames_,          c.bytes,         c.frames,           c.bad_checksum,
            c.framed_bytes,   c.skipped_bytes, parser_.position(), parser_.held(),
            parser_.missing()};
  }

 private:
  auto sink() {
    return [this](const Frame& frame) {
      frames_.push_back({frame.id, frame.offset, Buffer(frame.bytes.begin(), frame.bytes.end())});
    };
  }

  StreamParser<S> parser_;
  std::vector<Seen> frames_;
};

/// Feeds `stream` in pieces whose lengths `next_length()` gives.
template <Scanner S, class NextLength>
Run<S> run_in_pieces(Bytes stream, NextLength next_length, S scanner = {}) {
  Run<S> run(std::move(scanner));
  while (!stream.empty()) {
    const std::size_t length = std::min(stream.size(), static_cast<std::size_t>(next_length()));
    run.feed(stream.first(length));
    stream = stream.subspan(length);
  }
  return run;
}

template <Scanner S>
Outcome all_at_once(Bytes stream, S scanner = {}) {
  return run_in_pieces<S>(
             stream, [&] { return stream.size(); }, std::move(scanner))
      .outcome();
}

template <Scanner S>
Outcome byte_by_byte(Bytes stream, S scanner = {}) {
  return run_in_pieces<S>(
             stream, [] { return 1; }, std::move(scanner))
      .outcome();
}

inline void append(Buffer& stream, Bytes bytes) {
  std::copy(bytes.begin(), bytes.end(), std::back_inserter(stream));
}

/// Frames of `make_frame(random)`, whole, cut short, damaged, run into each other, with noise between them. The
/// noise likes the bytes that frames are made of.
template <class MakeFrame>
Buffer mixture(Random& random, MakeFrame make_frame, std::size_t pieces) {
  Buffer stream;
  for (std::size_t i = 0; i < pieces; ++i) {
    Buffer frame = make_frame(random);
    switch (below(random, 8)) {
      case 0:  // the end is missing
        frame.resize(below(random, frame.size()));
        break;
      case 1:  // the beginning is missing
        frame.erase(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(below(random, frame.size())));
        break;
      case 2:  // one bit flipped
        frame[below(random, frame.size())] ^= static_cast<std::uint8_t>(1U << below(random, 8));
        break;
      case 3: {  // noise of its own bytes
        Buffer noise(below(random, 200));
        for (auto& byte : noise) byte = frame[below(random, frame.size())];
        frame = noise;
        break;
      }
      case 4: {  // noise
        Buffer noise(below(random, 50));
        for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
        frame = noise;
        break;
      }
      default: break;
    }
    append(stream, frame);
  }
  return stream;
}

}  // namespace navcal::protocols::test

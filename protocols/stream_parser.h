// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstring>
#include <utility>

#include "protocols/frame.h"

namespace navcal::protocols {

/// Result of a scan at a place where a frame may begin.
struct Scan {
  enum class Kind : std::uint8_t {
    frame,         ///< `length` bytes from here are an intact frame
    bad_checksum,  ///< a whole candidate that fails; it is left by one byte, not by its length
    not_a_frame,   ///< cannot become a frame, whatever follows; left by one byte
    incomplete,    ///< may become a frame; at least `length` more bytes are needed
  };
  Kind kind = Kind::not_a_frame;
  std::size_t length = 0;
  FrameId id;

  static constexpr Scan frame(std::size_t length, FrameId id) { return {Kind::frame, length, id}; }
  static constexpr Scan bad_checksum() { return {Kind::bad_checksum, 0, {}}; }
  static constexpr Scan not_a_frame() { return {Kind::not_a_frame, 0, {}}; }
  static constexpr Scan incomplete(std::size_t missing) { return {Kind::incomplete, missing, {}}; }
};

/// Requirements on a protocol. `scan` sees a candidate from its first byte on and must decide on the shortest
/// prefix that suffices: once it has answered anything but `incomplete`, more bytes never change the answer. Given
/// kMaxFrameLength bytes it never answers `incomplete`. Therefore the frames of a stream do not depend on how its
/// bytes were divided into reads.
///
/// A scanner without members has static functions. One that a file describes is an object, and may be told the
/// last byte that was left, as a frame or skipped, by `left(byte)`: with it, a line can begin behind the end of
/// another.
template <class S>
concept Scanner = std::default_initializable<S> && requires(const S& scanner, const std::uint8_t* p) {
  { S::kMaxFrameLength } -> std::convertible_to<std::size_t>;
  { scanner.find_start(p, p) } -> std::same_as<const std::uint8_t*>;  // first byte that may begin a frame, or last
  { scanner.scan(p, p) } -> std::same_as<Scan>;
};

/// The first byte of this value, or last.
inline const std::uint8_t* find_byte(const std::uint8_t* first, const std::uint8_t* last, std::uint8_t byte) {
  if (first == last || *first == byte) return first;  // frames mostly follow each other: spare the call
  const void* const found = std::memchr(first, byte, static_cast<std::size_t>(last - first));
  return found != nullptr ? static_cast<const std::uint8_t*>(found) : last;
}

/// Base of scanners whose frames begin with one of these bytes.
template <std::uint8_t... starts>
struct StartsWith {
  static const std::uint8_t* find_start(const std::uint8_t* first, const std::uint8_t* last) {
    if constexpr (sizeof...(starts) == 1) {
      return find_byte(first, last, (starts, ...));
    } else {
      while (first != last && ((*first != starts) && ...)) ++first;
      return first;
    }
  }
};

/// Push parser: bytes in, frames out. No I/O, no clock, no allocation, no exceptions.
/// Frames are found in the caller's bytes where they lie; only an unfinished tail is copied and held.
template <Scanner S>
class StreamParser {
 public:
  StreamParser() = default;
  explicit StreamParser(S scanner) : scanner_(std::move(scanner)) {}

  /// Takes the bytes of one read; `sink(const Frame&)` is called for each frame completed by them.
  template <class Sink>
  void feed(Bytes bytes, Sink&& sink) {
    counters_.bytes += bytes.size();
    const std::uint8_t* next = bytes.data();
    const std::uint8_t* const last = next + bytes.size();
    while (held_ > 0 && next != last) {
      const auto appended = std::min(static_cast<std::size_t>(last - next), buffer_.size() - held_);
      std::memcpy(buffer_.data() + held_, next, appended);
      held_ += appended;
      next += appended;
      drain(sink);
      // The remaining bytes are all in the caller's buffer: continue there without copies.
      if (const auto fresh = static_cast<std::size_t>(next - bytes.data()); held_ <= fresh) {
        next -= held_;
        held_ = 0;
      }
    }
    if (held_ > 0) return;
    const std::uint8_t* const rest = scan_run(next, last, sink);
    held_ = static_cast<std::size_t>(last - rest);
    if (held_ > 0) std::memcpy(buffer_.data(), rest, held_);
  }

  /// The line has been silent for longer than the held candidate could need: give it up by one byte and
  /// look again at what follows. Nothing is thrown away that may still be a frame.
  template <class Sink>
  void silence(Sink&& sink) {
    if (held_ == 0) return;
    ++counters_.skipped_bytes;
    ++position_;
    --held_;
    leave(buffer_.data() + 1);
    std::memmove(buffer_.data(), buffer_.data() + 1, held_);
    drain(sink);
  }

  [[nodiscard]] const Counters& counters() const { return counters_; }
  /// Bytes held because they may still become a frame.
  [[nodiscard]] std::size_t held() const { return held_; }
  /// Least number of bytes that the held candidate still needs; 0 when nothing is held.
  [[nodiscard]] std::size_t missing() const { return held_ == 0 ? 0 : missing_; }
  /// Offset in the stream of the first byte that is held, or of the next byte to come.
  [[nodiscard]] std::uint64_t position() const { return position_; }

 private:
  template <class Sink>
  void drain(Sink& sink) {
    const std::uint8_t* const last = buffer_.data() + held_;
    const std::uint8_t* const rest = scan_run(buffer_.data(), last, sink);
    held_ = static_cast<std::size_t>(last - rest);
    std::memmove(buffer_.data(), rest, held_);
  }

  /// Scans [p, last); returns where an incomplete candidate begins, or last.
  template <class Sink>
  const std::uint8_t* scan_run(const std::uint8_t* p, const std::uint8_t* const last, Sink& sink) {
    while (p != last) {
      const std::uint8_t* const start = scanner_.find_start(p, last);
      if (start != p) leave(start);
      skip(static_cast<std::size_t>(start - p));
      p = start;
      if (p == last) break;
      const Scan found = scanner_.scan(p, last);
      switch (found.kind) {
        case Scan::Kind::frame:
          ++counters_.frames;
          counters_.framed_bytes += found.length;
          sink(Frame{found.id, position_, Bytes(p, found.length)});
          position_ += found.length;
          p += found.length;
          leave(p);
          break;
        case Scan::Kind::bad_checksum: ++counters_.bad_checksum; [[fallthrough]];
        case Scan::Kind::not_a_frame:
          skip(1);
          ++p;
          leave(p);
          break;
        case Scan::Kind::incomplete: missing_ = found.length; return p;
      }
    }
    return p;
  }

  /// All bytes before `next` have been left.
  void leave([[maybe_unused]] const std::uint8_t* next) {
    if constexpr (requires { scanner_.left(*next); }) scanner_.left(next[-1]);
  }

  void skip(std::size_t n) {
    counters_.skipped_bytes += n;
    position_ += n;
  }

  [[no_unique_address]] S scanner_;
  Counters counters_;
  std::uint64_t position_ = 0;
  std::size_t held_ = 0;
  std::size_t missing_ = 0;
  std::array<std::uint8_t, S::kMaxFrameLength> buffer_{};
};

}  // namespace navcal::protocols

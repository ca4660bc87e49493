// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/protocols/stream.h"

// Captures of devices by others, which are not ours to keep in the repository.
namespace navcal::protocols::test {

/// The bytes of `../shared/devices/<name>`; empty where there is no such file.
inline Buffer shared_capture(const std::string& name) {
  const std::filesystem::path path =
      std::filesystem::path(NAVCAL_SOURCE_DIR).parent_path() / "shared" / "devices" / name;
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The same frames and counters for a whole stream, single bytes and random pieces.
template <Scanner S>
bool same_however_cut(Bytes stream) {
  const Outcome whole = all_at_once<S>(stream);
  Random random(7);
  const Outcome pieces = run_in_pieces<S>(stream, [&] { return 1 + below(random, 97); }).outcome();
  return byte_by_byte<S>(stream) == whole && pieces == whole;
}

/// Frames of a stream that is cut after each byte in turn are those of the whole that end before the cut: they are
/// counted and compared. The stream begins with a frame.
template <Scanner S>
bool every_cut_gives_a_prefix(Bytes stream) {
  const Outcome whole = all_at_once<S>(stream);
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    const Outcome part = all_at_once<S>(stream.first(cut));
    if (part.frames.size() > whole.frames.size()) return false;
    for (std::size_t i = 0; i < part.frames.size(); ++i) {
      if (part.frames[i] != whole.frames[i]) return false;
    }
    if (part.framed_bytes + part.skipped_bytes + part.held != cut) return false;
  }
  return true;
}

/// Whether no frame is found at the start of an intact frame with any one bit flipped.
template <Scanner S>
bool every_flipped_bit_shows(const Buffer& frame) {
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    Buffer damaged = frame;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    for (const Seen& seen : all_at_once<S>(damaged).frames) {
      if (seen.offset == 0) return false;
    }
  }
  return true;
}

}  // namespace navcal::protocols::test

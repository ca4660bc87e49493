// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "analysis/device_guess_parts.h"

namespace navcal::analysis {
namespace {

using protocols::described::ByteOrder;
using protocols::described::Checksum;
using protocols::described::Sum;

constexpr std::size_t kFramesTried = 200;
/// So many frames tell a checksum of eight bits from chance, and so many one of more bits.
constexpr std::size_t kLeastFor8 = 8, kLeastForMore = 4;
constexpr double kLeastHolds = 0.95;

/// The strongest first: a chance hit of a weak one is likelier.
constexpr std::array kSums{Sum::crc32, Sum::crc16_ccitt, Sum::crc16_xmodem, Sum::crc16_modbus, Sum::fletcher16,
                           Sum::sum16, Sum::crc8,        Sum::xor8,         Sum::sum8,         Sum::negated_sum8};

std::uint32_t stated_sum(protocols::Bytes frame, std::size_t at, std::size_t size, ByteOrder order) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value |= std::uint32_t{frame[at + i]} << 8 * (order == ByteOrder::big ? size - 1 - i : i);
  return value;
}

bool sum_holds(const Checksum& checksum, protocols::Bytes frame) {
  const std::size_t size = size_of(checksum.sum), back = static_cast<std::size_t>(-checksum.at),
                    from = static_cast<std::size_t>(checksum.from);
  if (frame.size() < back + from + 1) return false;
  const std::size_t at = frame.size() - back;
  return sum_of(checksum.sum, frame.subspan(from, at - from)) == stated_sum(frame, at, size, checksum.byte_order);
}

bool holds_nearly_always(const Checksum& checksum, const std::vector<protocols::Bytes>& frames) {
  const auto may_fail = static_cast<std::size_t>((1 - kLeastHolds) * static_cast<double>(frames.size()));
  std::size_t failed = 0;
  for (const protocols::Bytes frame : frames) {
    if (!sum_holds(checksum, frame) && ++failed > may_fail) return false;
  }
  return true;
}

/// Frames that differ: equal ones would agree with anything that one agrees with.
std::vector<protocols::Bytes> different_frames(const Framing& framing) {
  std::vector<protocols::Bytes> frames;
  for (const protocols::Bytes frame : framing.frames) {
    if (frames.size() == kFramesTried) break;
    if (frames.empty() || !std::equal(frame.begin(), frame.end(), frames.back().begin(), frames.back().end()))
      frames.push_back(frame);
  }
  return frames;
}

}  // namespace

std::optional<Checksum> find_checksum(const Framing& framing) {
  constexpr int kBehind = 2;  // bytes such as <CR><LF>
  constexpr int kLastFrom = 8;
  const auto frames = different_frames(framing);
  for (const Sum sum : kSums) {
    const auto size = static_cast<int>(size_of(sum));
    if (frames.size() < (size == 1 ? kLeastFor8 : kLeastForMore)) continue;
    for (int behind = 0; behind <= kBehind; ++behind) {
      for (const ByteOrder order : {ByteOrder::big, ByteOrder::little}) {
        if (size == 1 && order == ByteOrder::big) continue;
        for (int from = 0; from <= kLastFrom; ++from) {
          Checksum checksum;
          checksum.sum = sum;
          checksum.at = checksum.to = -size - behind;
          checksum.from = from;
          checksum.byte_order = order;
          if (holds_nearly_always(checksum, frames)) return checksum;
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace navcal::analysis

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/device_guess_parts.h"
#include "protocols/described/plan.h"

namespace navcal::analysis {
namespace {

using protocols::Bytes;
using protocols::described::ByteOrder;
using protocols::described::kMaxFrameLength;
using protocols::described::Length;
using NumberType = protocols::described::Type;

constexpr std::size_t kCandidates = 128;
constexpr std::size_t kLeastFrames = 4;
constexpr std::size_t kShortestFrame = 4;

using Places = std::vector<std::size_t>;

/// Pairs of neighbouring bytes, the most frequent first.
std::vector<unsigned> frequent_pairs(Bytes capture) {
  std::vector<std::size_t> counts(65536);
  for (std::size_t i = 0; i + 1 < capture.size(); ++i) ++counts[capture[i] * 256U + capture[i + 1]];
  std::vector<unsigned> pairs(counts.size());
  std::iota(pairs.begin(), pairs.end(), 0U);
  std::partial_sort(pairs.begin(), pairs.begin() + kCandidates, pairs.end(),
                    [&](unsigned a, unsigned b) { return counts[a] > counts[b]; });
  pairs.resize(kCandidates);
  const std::size_t least = std::max(kLeastFrames, capture.size() / kMaxFrameLength / 2);
  std::erase_if(pairs, [&](unsigned pair) { return counts[pair] < least; });
  return pairs;
}

Places places_of(Bytes capture, unsigned pair) {
  Places places;
  for (std::size_t i = 0; i + 1 < capture.size(); ++i) {
    if (capture[i] * 256U + capture[i + 1] == pair) places.push_back(i);
  }
  return places;
}

/// The number that counts most often among some; `share` is its part of all.
template <class Number>
Number most_frequent(const std::vector<Number>& numbers, double& share) {
  std::map<Number, std::size_t> counts;
  for (const Number number : numbers) ++counts[number];
  const auto most =
      std::ranges::max_element(counts, [](const auto& a, const auto& b) { return a.second < b.second; });
  share = most == counts.end() ? 0 : static_cast<double>(most->second) / static_cast<double>(numbers.size());
  return most == counts.end() ? Number{} : most->first;
}

std::size_t stated_length(const Length& length, Bytes from) {
  if (length.fixed != 0) return length.fixed;
  if (from.size() < length.at + size_of(length.type)) return 0;
  const std::int64_t stated =
      protocols::described::integer_at(from.data() + length.at, length.type, length.byte_order == ByteOrder::big) +
      length.add;
  return stated < static_cast<std::int64_t>(kShortestFrame) || stated > static_cast<std::int64_t>(kMaxFrameLength)
             ? 0
             : static_cast<std::size_t>(stated);
}

bool has_sync(Bytes capture, std::size_t at, const std::string& sync) {
  if (at + sync.size() > capture.size()) return false;
  return std::equal(sync.begin(), sync.end(), capture.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

/// Frames that are followed by another one, or by the end.
void collect_frames(Bytes capture, Framing& framing) {
  std::size_t framed = 0;
  for (std::size_t at = 0; at + framing.sync.size() <= capture.size();) {
    const std::size_t length =
        has_sync(capture, at, framing.sync) ? stated_length(framing.length, capture.subspan(at)) : 0;
    const std::size_t end = at + length;
    if (length == 0 || end > capture.size() ||
        (end + framing.sync.size() <= capture.size() && !has_sync(capture, end, framing.sync))) {
      ++at;
      continue;
    }
    framing.frames.push_back(capture.subspan(at, length));
    framed += length;
    at = end;
  }
  framing.coverage = static_cast<double>(framed) / static_cast<double>(capture.size());
}

/// Makes the sync longer by bytes that never change.
void lengthen_sync(Framing& framing) {
  constexpr std::size_t kLongestSync = 4;
  while (framing.sync.size() < kLongestSync) {
    const std::size_t at = framing.sync.size();
    const bool is_length = framing.length.fixed == 0 && at >= framing.length.at;
    const auto differs = [&](Bytes frame) {
      return frame.size() <= at || frame[at] != framing.frames.front()[at];
    };
    if (is_length || std::ranges::any_of(framing.frames, differs)) return;
    // A zero that never changes is rather the upper half of a small number.
    if (framing.frames.front()[at] == 0) return;
    framing.sync += static_cast<char>(framing.frames.front()[at]);
  }
}

void try_length(Bytes capture, const std::string& sync, const Length& length, std::vector<Framing>& framings) {
  Framing framing{sync, length, {}, 0};
  collect_frames(capture, framing);
  if (framing.frames.size() < kLeastFrames) return;
  framings.push_back(std::move(framing));
}

/// Numbers behind the sync that state the distance to the next one, but for a constant.
void try_stated_lengths(Bytes capture, const std::string& sync, const Places& places,
                        std::vector<Framing>& framings) {
  constexpr std::uint16_t kLastPlace = 7;
  constexpr double kLeastShareOfFrames = 0.4;
  for (std::uint16_t at = 2; at <= kLastPlace; ++at) {
    for (const auto& [type, order] :
         {std::pair(NumberType::u8, ByteOrder::little), std::pair(NumberType::u16, ByteOrder::little),
          std::pair(NumberType::u16, ByteOrder::big)}) {
      std::vector<std::int64_t> differences;
      for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        if (places[i] + at + size_of(type) > capture.size()) break;
        const std::int64_t stated =
            protocols::described::integer_at(capture.data() + places[i] + at, type, order == ByteOrder::big);
        differences.push_back(static_cast<std::int64_t>(places[i + 1] - places[i]) - stated);
      }
      double share = 0;
      const std::int64_t add = most_frequent(differences, share);
      if (share < kLeastShareOfFrames || std::abs(add) > 64) continue;
      try_length(capture, sync, {0, at, type, order, 1, static_cast<int>(add), kMaxFrameLength}, framings);
    }
  }
}

void try_pair(Bytes capture, unsigned pair, std::vector<Framing>& framings) {
  const Places places = places_of(capture, pair);
  if (places.size() < kLeastFrames) return;
  const std::string sync{static_cast<char>(pair >> 8), static_cast<char>(pair & 0xFFU)};
  std::vector<std::size_t> distances;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) distances.push_back(places[i + 1] - places[i]);
  double share = 0;
  const std::size_t distance = most_frequent(distances, share);
  if (distance >= kShortestFrame && distance <= kMaxFrameLength) {
    Length fixed;
    fixed.fixed = distance;
    try_length(capture, sync, fixed, framings);
  }
  constexpr double kFixed = 0.9;
  if (share < kFixed) try_stated_lengths(capture, sync, places, framings);
}

/// Sync bytes are chosen to be rare: not 00 and not FF.
bool is_likely_sync(const std::string& sync) {
  return std::none_of(sync.begin(), sync.begin() + 2, [](char byte) { return byte == '\0' || byte == '\xFF'; });
}

}  // namespace

std::vector<Framing> find_framings(Bytes capture) {
  std::vector<Framing> framings;
  for (const unsigned pair : frequent_pairs(capture)) try_pair(capture, pair, framings);
  for (Framing& framing : framings) lengthen_sync(framing);
  constexpr double kUnlikely = 0.85;
  const auto rank = [](const Framing& framing) {
    return framing.coverage * (is_likely_sync(framing.sync) ? 1 : kUnlikely);
  };
  std::ranges::stable_sort(framings, [&](const Framing& a, const Framing& b) { return rank(a) > rank(b); });
  return framings;
}

}  // namespace navcal::analysis

// SPDX-License-Identifier: Apache-2.0
#include "protocols/mavlink_signer.h"

#include <nettle/memops.h>
#include <nettle/sha2.h>

#include <algorithm>
#include <chrono>

namespace navcal::protocols::mavlink {
namespace {

constexpr std::size_t kStamp = 7, kTag = 6, kSigned = kStamp + kTag;
constexpr std::uint64_t kMinute = 6'000'000;  // 10 us

/// Of `covered`, which ends with link and time.
std::array<std::uint8_t, kTag> tag_of(const Signer::Key& key, Bytes covered) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, key.size(), key.data());
  sha256_update(&context, covered.size(), covered.data());
  std::array<std::uint8_t, kTag> tag{};
  sha256_digest(&context, tag.size(), tag.data());
  return tag;
}

std::uint64_t clock_10us() {
  using namespace std::chrono;
  constexpr auto kBegin = sys_days{year{2015} / 1 / 1};
  const auto since = std::chrono::floor<microseconds>(system_clock::now() - kBegin);
  return since.count() > 0 ? static_cast<std::uint64_t>(since.count()) / 10 : 0;
}

}  // namespace

void Signer::sign(std::vector<std::uint8_t>& frame) {
  time_ = std::max(time_ + 1, clock_10us());
  frame[2] |= 1U;  // which the checksum covers
  frame.resize(frame.size() - 2);
  append_checksum(frame, frame[7] | std::uint32_t{frame[8]} << 8 | std::uint32_t{frame[9]} << 16);
  frame.push_back(0);  // link
  for (unsigned bits = 0; bits < 48; bits += 8) frame.push_back(static_cast<std::uint8_t>(time_ >> bits));
  const auto tag = tag_of(key_, frame);
  frame.insert(frame.end(), tag.begin(), tag.end());
}

Signer::Verdict Signer::check(Bytes frame) {
  if (frame.size() < 10 + 2 + kSigned || frame[0] != 0xFD || (frame[2] & 1U) == 0) return Verdict::not_signed;
  const Bytes covered = frame.first(frame.size() - kTag);
  if (memeql_sec(tag_of(key_, covered).data(), frame.last(kTag).data(), kTag) == 0) return Verdict::wrong;
  const std::uint8_t* const stamp = covered.data() + covered.size() - kStamp;
  const std::uint64_t time = get_le<std::uint64_t>(stamp) >> 8 & 0xFFFF'FFFF'FFFF;  // behind the link
  std::uint64_t& newest = newest_[std::uint32_t{stamp[0]} << 16 | std::uint32_t{frame[5]} << 8 | frame[6]];
  if (time <= newest || time + kMinute < time_) return Verdict::replayed;
  newest = time;
  time_ = std::max(time_, time);
  return Verdict::good;
}

}  // namespace navcal::protocols::mavlink

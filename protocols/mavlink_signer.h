// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "protocols/mavlink.h"

namespace navcal::protocols::mavlink {

/// Signatures of MAVLink 2 by a key that both ends have: the first 48 bits of SHA-256 over key, frame, link and a
/// time that only grows. One for each link.
class Signer {
 public:
  using Key = std::array<std::uint8_t, 32>;
  explicit Signer(const Key& key) : key_(key) {}

  /// Makes a signed frame of one of encode(), with a time of the system's clock, or later than all that was seen.
  void sign(std::vector<std::uint8_t>& frame);

  /// `replayed`: not later than a frame of the same sender and link, or more than a minute older than the newest
  /// that came or was signed here.
  enum class Verdict : std::uint8_t { good, not_signed, wrong, replayed };
  /// Of a whole frame. Reads no clock.
  [[nodiscard]] Verdict check(Bytes frame);

 private:
  Key key_;
  std::uint64_t time_ = 0;                         ///< newest that was sent or came; 10 us since 2015
  std::map<std::uint32_t, std::uint64_t> newest_;  ///< by link, system and component
};

}  // namespace navcal::protocols::mavlink

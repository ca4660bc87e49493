// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace navcal::link {

/// Counters of the frames that have come: each is taken once, and none that is 64 or more behind the newest (the
/// window of IPsec, RFC 4303 section 3.4.3). Shows the share of frames that were lost, too.
class Arrivals {
 public:
  /// False: a frame with this counter came before, or is too old to know.
  bool take(std::uint32_t counter) {
    if (counter > newest_) {
      const std::uint32_t ahead = counter - newest_;
      seen_ = ahead >= 64 ? 1 : seen_ << ahead | 1;
      newest_ = counter;
      return true;
    }
    const std::uint32_t behind = newest_ - counter;
    if (counter == 0 || behind >= 64 || (seen_ >> behind & 1) != 0) return false;
    seen_ |= std::uint64_t{1} << behind;
    return true;
  }
  [[nodiscard]] std::uint32_t newest() const { return newest_; }
  /// Of the last 64 frames sent, those that have not come, 0 to 1.
  [[nodiscard]] double loss() const {
    const std::uint32_t known = newest_ < 64 ? newest_ : 64;
    return known == 0 ? 0 : 1 - static_cast<double>(std::popcount(seen_)) / known;
  }

 private:
  std::uint32_t newest_ = 0;  ///< counters begin with 1
  std::uint64_t seen_ = 0;    ///< bit n: newest_ - n has come
};

}  // namespace navcal::link

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>

namespace navcal::fuzz {

/// Takes numbers from the fuzzer's bytes; zeros when they are used up.
class Source {
 public:
  explicit Source(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  template <class T>
  T take() {
    T value{};
    const std::size_t size = std::min(sizeof value, bytes_.size());
    std::memcpy(&value, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
    return value;
  }
  /// Mostly what an instrument could say, sometimes any 64 bits at all.
  double number(double typical) {
    if (take<std::uint8_t>() < 8) return take<double>();
    return typical * take<std::int16_t>() / 16384.0;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace navcal::fuzz

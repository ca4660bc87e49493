// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace navcal::analysis::ros {

/// Reads CDR (DDS-XTYPES, plain version 1) from front to back. What lies beyond the end reads as zero.
class CdrReader {
 public:
  explicit CdrReader(std::string_view message) : body_(message.substr(std::min<std::size_t>(message.size(), 4))) {
    constexpr std::size_t kHead = 4;
    is_good_ = message.size() >= kHead && message[0] == 0 && (message[1] == 0 || message[1] == 1);
    is_swapped_ = message.size() >= kHead && message[1] == 0;
  }
  [[nodiscard]] bool is_good() const { return is_good_; }

  template <class T>
  T take() {
    at_ = (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    std::array<char, sizeof(T)> bytes{};
    if (at_ + sizeof(T) > body_.size()) {
      is_good_ = false;
    } else {
      std::copy_n(body_.data() + at_, sizeof(T), bytes.begin());
    }
    at_ += sizeof(T);
    if (is_swapped_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }
  template <std::size_t N>
  std::array<double, N> take_doubles() {
    std::array<double, N> values{};
    for (double& value : values) value = take<double>();
    return values;
  }
  /// A text without the zero at its end.
  std::string take_text() {
    const auto length = take<std::uint32_t>();
    if (at_ > body_.size() || length > body_.size() - at_) is_good_ = false;
    if (!is_good_ || length == 0) return {};
    const std::string text(body_.substr(at_, length - 1));
    at_ += length;
    return text;
  }
  /// Number of elements of a list, each of at least `least_bytes`; 0 where so many cannot be there.
  std::size_t take_count(std::size_t least_bytes) {
    const std::size_t count = take<std::uint32_t>();
    if (at_ <= body_.size() && count <= (body_.size() - at_) / least_bytes) return count;
    is_good_ = is_good_ && count == 0;
    return 0;
  }
  void skip_text() {
    const auto length = take<std::uint32_t>();
    if (length > body_.size()) is_good_ = false;
    at_ += is_good_ ? length : 0;
  }
  /// std_msgs/Header: the stamp; its frame is passed over.
  std::int64_t take_header() {
    const std::int64_t seconds = take<std::int32_t>();
    const std::int64_t ns = take<std::uint32_t>();
    skip_text();
    return seconds * 1'000'000'000 + ns;
  }

 private:
  std::string_view body_;
  std::size_t at_ = 0;
  bool is_good_ = false;
  bool is_swapped_ = false;
};

}  // namespace navcal::analysis::ros

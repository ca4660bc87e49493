// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "link/frame.h"

namespace navcal::link {

/// Writes whole numbers, big-endian, two's complement.
class FieldWriter {
 public:
  template <std::integral T>
  void put(T value) {
    for (int shift = 8 * (static_cast<int>(sizeof(T)) - 1); shift >= 0; shift -= 8)
      bytes_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> shift));
  }
  /// `value / unit` rounded. Absent values and those that are no number are the type's reserved value: the least
  /// of a signed type, the greatest of another. A value beyond the type's range is the nearest one within.
  template <std::integral T>
  void put_scaled(const std::optional<double>& value, double unit) {
    put(value && std::isfinite(*value) ? scaled<T>(*value / unit) : reserved<T>());
  }
  /// One byte of length, then the text, cut after `longest` bytes.
  void put_text(std::string_view text, std::size_t longest) {
    text = text.substr(0, longest);
    put(static_cast<std::uint8_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
  }
  void put_bytes(Bytes bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  [[nodiscard]] Buffer take() && { return std::move(bytes_); }

  template <std::integral T>
  static constexpr T reserved() {
    return std::signed_integral<T> ? std::numeric_limits<T>::min() : std::numeric_limits<T>::max();
  }

 private:
  template <std::integral T>
  static T scaled(double value) {
    const double low = std::signed_integral<T> ? static_cast<double>(std::numeric_limits<T>::min()) + 1 : 0;
    const double high = static_cast<double>(std::numeric_limits<T>::max()) - (std::signed_integral<T> ? 0 : 1);
    return static_cast<T>(std::clamp(std::round(value), low, high));
  }

  Buffer bytes_;
};

/// Reads what FieldWriter wrote. Beyond the end everything is 0, and is_whole() is false.
class FieldReader {
 public:
  explicit FieldReader(Bytes bytes) : left_(bytes) {}

  template <std::integral T>
  T get() {
    if (left_.size() < sizeof(T)) {
      whole_ = false;
      left_ = {};
      return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) value = value << 8 | left_[i];
    left_ = left_.subspan(sizeof(T));
    return static_cast<T>(value);
  }
  template <std::integral T>
  std::optional<double> get_scaled(double unit) {
    const T value = get<T>();
    if (value == FieldWriter::reserved<T>()) return std::nullopt;
    return static_cast<double>(value) * unit;
  }
  std::string get_text() {
    const Bytes text = get_bytes(get<std::uint8_t>());
    return {text.begin(), text.end()};
  }
  Bytes get_bytes(std::size_t length) {
    if (left_.size() < length) {
      whole_ = false;
      length = left_.size();
    }
    const Bytes bytes = left_.first(length);
    left_ = left_.subspan(length);
    return bytes;
  }
  [[nodiscard]] Bytes rest() const { return left_; }
  /// True when nothing was read beyond the end.
  [[nodiscard]] bool is_whole() const { return whole_; }

 private:
  Bytes left_;
  bool whole_ = true;
};

}  // namespace navcal::link

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

/// Writes whole numbers, big-endian, two's complement. A layout is stated once, as a function of a writer or a
/// FieldReader: number(), scaled(), text() and flags() go both ways.
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
  void scaled(const std::optional<double>& value, double unit) {
    put(value && std::isfinite(*value) ? within<T>(*value / unit) : reserved<T>());
  }
  /// One byte of length, then the text, cut after `longest` bytes.
  void text(std::string_view text, std::size_t longest) {
    text = text.substr(0, longest);
    put(static_cast<std::uint8_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
  }
  template <std::integral T>
  void number(T value) {
    put(value);
  }
  /// One byte, the first in its lowest bit.
  template <class... Flags>
  void flags(const Flags&... flags) {
    unsigned byte = 0, bit = 0;
    ((byte |= unsigned{flags} << bit++), ...);
    put(static_cast<std::uint8_t>(byte));
  }
  void put_bytes(Bytes bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  [[nodiscard]] Buffer take() && { return std::move(bytes_); }

  template <std::integral T>
  static constexpr T reserved() {
    return std::signed_integral<T> ? std::numeric_limits<T>::min() : std::numeric_limits<T>::max();
  }

 private:
  template <std::integral T>
  static T within(double value) {
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
  void number(T& value) {
    value = get<T>();
  }
  template <std::integral T>
  void scaled(std::optional<double>& value, double unit) {
    const T number = get<T>();
    value =
        number == FieldWriter::reserved<T>() ? std::nullopt : std::optional(static_cast<double>(number) * unit);
  }
  /// A value that has to be there: without one the message is not whole.
  template <std::integral T>
  void scaled(double& value, double unit) {
    std::optional<double> read;
    scaled<T>(read, unit);
    whole_ = whole_ && read;
    value = read.value_or(0);
  }
  void text(std::string& value, std::size_t) {
    const Bytes bytes = get_bytes(get<std::uint8_t>());
    value.assign(bytes.begin(), bytes.end());
  }
  template <class... Flags>
  void flags(Flags&... flags) {
    unsigned byte = get<std::uint8_t>();
    ((flags = (byte & 1U) != 0, byte >>= 1U), ...);
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
  /// And nothing is left.
  [[nodiscard]] bool is_all() const { return whole_ && left_.empty(); }

 private:
  Bytes left_;
  bool whole_ = true;
};

}  // namespace navcal::link

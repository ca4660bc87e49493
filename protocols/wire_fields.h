// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "protocols/frame.h"

/// Numbers in binary messages: integers in two's complement and IEEE 754 floats, in either byte order.
namespace navcal::protocols {

template <class T>
concept WireNumber = std::integral<T> ||(std::floating_point<T> && sizeof(T) <= 8);

namespace detail {

template <std::size_t Size>
using UnsignedOfSize = std::conditional_t<
    Size == 1, std::uint8_t,
    std::conditional_t<Size == 2, std::uint16_t, std::conditional_t<Size == 4, std::uint32_t, std::uint64_t>>>;

}  // namespace detail

/// The number of type T that begins at `p`, least significant byte first.
template <WireNumber T>
[[nodiscard]] T get_le(const std::uint8_t* p) {
  using Raw = detail::UnsignedOfSize<sizeof(T)>;
  std::uint64_t raw = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) raw |= std::uint64_t{p[i]} << 8 * i;
  return std::bit_cast<T>(static_cast<Raw>(raw));
}

/// The number of type T that begins at `p`, most significant byte first.
template <WireNumber T>
[[nodiscard]] T get_be(const std::uint8_t* p) {
  using Raw = detail::UnsignedOfSize<sizeof(T)>;
  std::uint64_t raw = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) raw = raw << 8 | p[i];
  return std::bit_cast<T>(static_cast<Raw>(raw));
}

template <WireNumber T>
void put_le(std::uint8_t* p, T value) {
  const std::uint64_t raw = std::bit_cast<detail::UnsignedOfSize<sizeof(T)>>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) p[i] = static_cast<std::uint8_t>(raw >> 8 * i);
}

template <WireNumber T>
void put_be(std::uint8_t* p, T value) {
  const std::uint64_t raw = std::bit_cast<detail::UnsignedOfSize<sizeof(T)>>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) p[i] = static_cast<std::uint8_t>(raw >> 8 * (sizeof(T) - 1 - i));
}

template <WireNumber T>
void append_le(std::vector<std::uint8_t>& bytes, T value) {
  bytes.resize(bytes.size() + sizeof(T));
  put_le(&bytes[bytes.size() - sizeof(T)], value);
}

/// Numbers one after the other, each with the least significant byte first.
template <WireNumber... T>
[[nodiscard]] std::vector<std::uint8_t> packed_le(T... values) {
  std::vector<std::uint8_t> bytes;
  (append_le(bytes, values), ...);
  return bytes;
}

template <WireNumber T>
void append_be(std::vector<std::uint8_t>& bytes, T value) {
  bytes.resize(bytes.size() + sizeof(T));
  put_be(&bytes[bytes.size() - sizeof(T)], value);
}

/// `value` rounded to the nearest integer; the nearest end of the range of T when it does not fit, 0 for NaN.
template <std::integral T>
[[nodiscard]] T saturated(double value) {
  if (std::isnan(value)) return 0;
  const double rounded = std::round(value);
  if (rounded <= static_cast<double>(std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
  if (rounded >= static_cast<double>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
  return static_cast<T>(rounded);
}

/// Fields of a message at their places, little-endian unless it is said otherwise. A layout is stated once, as a
/// function of one of these two: the one takes the members from the message, the other puts them into it.
class LayoutReader {
 public:
  explicit LayoutReader(Bytes message, bool is_big = false) : message_(message), is_big_(is_big) {}

  [[nodiscard]] std::size_t size() const { return message_.size(); }
  template <WireNumber T>
  void number(std::size_t at, T& value) const {
    value = is_big_ ? get_be<T>(&message_[at]) : get_le<T>(&message_[at]);
  }
  /// A whole number of steps.
  template <std::integral T>
  void scaled(std::size_t at, double& value, double step) const {
    T steps{};
    number(at, steps);
    value = static_cast<double>(steps) * step;
  }
  /// A whole number of parts, of which the unit has so many.
  template <std::integral T>
  void parts(std::size_t at, double& value, double per_unit) const {
    T parts{};
    number(at, parts);
    value = static_cast<double>(parts) / per_unit;
  }
  template <class T>
  void bits(std::size_t at, unsigned lowest, unsigned width, T& value) const {
    value = static_cast<T>(message_[at] >> lowest & ((1U << width) - 1));
  }

 private:
  Bytes message_;
  bool is_big_;
};

class LayoutWriter {
 public:
  explicit LayoutWriter(std::vector<std::uint8_t>& message, bool is_big = false)
      : message_(message), is_big_(is_big) {}

  [[nodiscard]] std::size_t size() const { return message_.size(); }
  template <WireNumber T>
  void number(std::size_t at, const T& value) const {
    is_big_ ? put_be(&message_[at], value) : put_le(&message_[at], value);
  }
  template <std::integral T>
  void scaled(std::size_t at, double value, double step) const {
    number(at, saturated<T>(value / step));
  }
  template <std::integral T>
  void parts(std::size_t at, double value, double per_unit) const {
    number(at, saturated<T>(value * per_unit));
  }
  template <class T>
  void bits(std::size_t at, unsigned lowest, unsigned width, const T& value) const {
    const unsigned mask = (1U << width) - 1;
    message_[at] = static_cast<std::uint8_t>((message_[at] & ~(mask << lowest)) |
                                             (static_cast<unsigned>(value) & mask) << lowest);
  }

 private:
  std::vector<std::uint8_t>& message_;
  bool is_big_;
};

}  // namespace navcal::protocols

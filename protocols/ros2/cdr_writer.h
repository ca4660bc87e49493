// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace navcal::protocols::ros2 {

/// Writes CDR (DDS-XTYPES, plain version 1, little-endian) with its encapsulation, member by member.
class CdrWriter {
 public:
  template <class... Members>
  void operator()(const Members&... members) {
    (write(members), ...);
  }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  static constexpr std::size_t kHead = 4;  // alignment counts from behind it

  template <class T>
  void write(const T& value) {
    if constexpr (std::is_class_v<T>) {
      value.visit(*this);
    } else {
      static_assert(std::endian::native == std::endian::little);
      out_.append((sizeof(T) - (out_.size() - kHead) % sizeof(T)) % sizeof(T), '\0');
      const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
      out_.append(bytes.data(), bytes.size());
    }
  }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size() + 1));
    out_.append(text.c_str(), text.size() + 1);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& values) {
    for (const T& value : values) write(value);
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write(static_cast<std::uint32_t>(values.size()));
    for (const T& value : values) write(value);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.value_or(T{}));
  }

  std::string out_{0, 1, 0, 0};
};

template <class Message>
[[nodiscard]] std::string encode(const Message& message) {
  CdrWriter writer;
  message.visit(writer);
  return writer.take();
}

}  // namespace navcal::protocols::ros2

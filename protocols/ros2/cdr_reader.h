// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace navcal::protocols::ros2 {

/// Reads CDR (DDS-XTYPES, plain version 1) of either byte order, member by member: `message.visit(reader)`. What
/// lies beyond the end reads as zero, and lengths are believed only as far as there are bytes.
class CdrReader {
 public:
  explicit CdrReader(std::string_view message) : body_(message.substr(std::min<std::size_t>(message.size(), 4))) {
    constexpr std::size_t kHead = 4;
    is_good_ = message.size() >= kHead && message[0] == 0 && (message[1] == 0 || message[1] == 1);
    is_swapped_ = message.size() >= kHead && message[1] == 0;
  }
  [[nodiscard]] bool is_good() const { return is_good_; }

  template <class... Members>
  void operator()(Members&... members) {
    (read(members), ...);
  }

 private:
  template <class T>
  T number() {
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
  template <class T>
  void read(T& value) {
    if constexpr (std::is_class_v<T>) {
      value.visit(*this);
    } else {
      value = number<T>();
    }
  }
  void read(bool& flag) { flag = number<std::uint8_t>() != 0; }
  void read(std::string& text) {
    const auto length = number<std::uint32_t>();
    if (at_ > body_.size() || length > body_.size() - at_) is_good_ = false;
    if (!is_good_ || length == 0) return text.clear();
    text = body_.substr(at_, length - 1);  // without the zero at its end
    at_ += length;
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& values) {
    for (T& value : values) read(value);
  }
  template <class T>
  void read(std::vector<T>& values) {
    values.clear();
    for (auto count = number<std::uint32_t>(); count > 0 && is_good_; --count) read(values.emplace_back());
  }
  /// The last member of a type, which senders of older distributions leave out.
  template <class T>
  void read(std::optional<T>& value) {
    if (at_ < body_.size()) read(value.emplace());
  }

  std::string_view body_;
  std::size_t at_ = 0;
  bool is_good_ = false;
  bool is_swapped_ = false;
};

/// nullopt when the bytes are no CDR or fewer than the message has.
template <class Message>
[[nodiscard]] std::optional<Message> decode(std::string_view cdr) {
  CdrReader reader(cdr);
  Message message;
  message.visit(reader);
  return reader.is_good() ? std::optional(std::move(message)) : std::nullopt;
}

}  // namespace navcal::protocols::ros2

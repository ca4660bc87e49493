// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

namespace navcal::base {

/// Text on its way to a descriptor, through one large buffer. Throws Failure when it cannot be written, with the
/// reason (the reader has gone, the disk is full).
class Output {
 public:
  /// `name` stands in messages: "standard output".
  Output(int descriptor, std::string name);

  void append(std::string_view text) {
    if (text.size() > kCapacity) return append_piecewise(text);
    char* const place = room(text.size());
    std::memcpy(place, text.data(), text.size());
    next_ = place + text.size();
  }
  void append(char c) {
    *room(1) = c;
    ++next_;
  }
  /// Room for `n` bytes (at most kCapacity), to be written from there on and claimed by wrote().
  char* room(std::size_t n) {
    if (static_cast<std::size_t>(buffer_->data() + kCapacity - next_) < n) flush();
    return next_;
  }
  void wrote(char* end) { next_ = end; }
  void flush();

 private:
  static constexpr std::size_t kCapacity = std::size_t{256} << 10;

  void append_piecewise(std::string_view text);

  int descriptor_;
  std::string name_;
  std::unique_ptr<std::array<char, kCapacity>> buffer_;
  char* next_;
};

}  // namespace navcal::base

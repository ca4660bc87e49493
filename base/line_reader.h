// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace navcal::base {

/// Without these characters at either end.
[[nodiscard]] constexpr std::string_view trimmed(std::string_view text, std::string_view ends = " \t\r\n") {
  text.remove_prefix(text.find_first_not_of(ends) == text.npos ? text.size() : text.find_first_not_of(ends));
  return text.substr(0, text.find_last_not_of(ends) + 1);
}

/// Takes what stands before the first of these separators off the front of `text`, and that separator.
constexpr std::string_view take_until(std::string_view& text, std::string_view separators) {
  const bool is_one = separators.size() == 1;
  const std::string_view front =
      text.substr(0, is_one ? text.find(separators.front()) : text.find_first_of(separators));
  text.remove_prefix(front.size() < text.size() ? front.size() + 1 : text.size());
  return front;
}

/// Cuts a stream of text into lines without ever holding more than `max_length` of it. A line longer than that
/// makes the reader refuse everything from then on.
class LineReader {
 public:
  explicit LineReader(std::size_t max_length) : max_length_(max_length) {}

  /// Calls `on_line(std::string_view)` for each line completed, without its end, LF or CR LF. False once a line
  /// was too long.
  template <class OnLine>
  [[nodiscard]] bool feed(std::string_view text, OnLine&& on_line) {
    while (!refused_ && !text.empty()) {
      const auto end = text.find('\n');
      const auto part = text.substr(0, end);
      if (held_.size() + part.size() > max_length_) {
        refused_ = true;
        held_.clear();
        break;
      }
      if (end == std::string_view::npos) {
        held_ += part;
        break;
      }
      text.remove_prefix(end + 1);
      if (held_.empty()) {
        on_line(without_cr(part));
      } else {
        held_ += part;
        on_line(without_cr(held_));
        held_.clear();
      }
    }
    return !refused_;
  }

  /// Beginning of a line that is not complete yet. Call forget() after using `length` characters of it.
  [[nodiscard]] std::string_view held() const { return held_; }
  void forget(std::size_t length) { held_.erase(0, length); }

 private:
  static std::string_view without_cr(std::string_view line) {
    return line.substr(0, line.size() - (line.ends_with('\r') ? 1 : 0));
  }

  std::size_t max_length_;
  std::string held_;
  bool refused_ = false;
};

}  // namespace navcal::base

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>

#include "protocols/decimal.h"

/// Fields between commas, as instruments print them.
namespace navcal::protocols {

/// The whole of `text` as a finite number with an optional sign and exponent, blanks before it allowed.
[[nodiscard]] inline std::optional<double> signed_number(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  const auto value = real(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// How a number is printed: filled up with zeros to `digits` before the point, with `+` where it is not negative.
struct Print {
  int decimals = 0;
  std::size_t digits = 1;
  bool plus = false;
};

// The fields of a line are stated once, as a function of one of the two classes that follow: the one takes the
// members from the text, the other appends them.

/// Takes fields one after the other. One that is no number where one should be refuses the line.
class LineReader {
 public:
  using Parse = std::optional<double>(std::string_view);

  /// `text`: from the first field on.
  explicit LineReader(std::string_view text, Parse* parse = signed_number) : rest_(text), parse_(parse) {}
  /// Whether these were all fields, and each could be what it should be.
  [[nodiscard]] bool are_good() const { return is_good_ && is_over_; }
  void refuse_unless(bool is_good) { is_good_ = is_good_ && is_good; }

  std::string_view take() {
    refuse_unless(!is_over_);
    const std::size_t comma = rest_.find(',');
    const std::string_view field = rest_.substr(0, comma);
    is_over_ = comma == std::string_view::npos;
    rest_.remove_prefix(is_over_ ? rest_.size() : comma + 1);
    return field;
  }
  void number(double& value, Print = {}) { keep(value, parse_(take())); }
  template <std::integral T>
  void number(T& value, Print = {}) {
    keep(value, integer<T>(take()));
  }
  /// An empty field leaves `value` absent.
  template <class T, class... Prints>
  void number(std::optional<T>& value, Prints... print) {
    if (rest_.empty() || rest_.front() == ',') return static_cast<void>(take());
    number(value.emplace(), print...);
  }
  template <class T, std::size_t N, class... Prints>
  void number(std::array<T, N>& values, Prints... print) {
    for (T& value : values) number(value, print...);
  }
  void letter(bool& value, char yes, char no) {
    const std::string_view field = take();
    value = field == std::string_view(&yes, 1);
    refuse_unless(value || field == std::string_view(&no, 1));
  }

 private:
  template <class T>
  void keep(T& value, const std::optional<T>& read) {
    refuse_unless(read.has_value());
    value = read.value_or(T{});
  }

  std::string_view rest_;
  Parse* parse_;
  bool is_good_ = true, is_over_ = false;
};

class LineWriter {
 public:
  /// `name`: what stands before the comma of the first field.
  explicit LineWriter(std::string_view name) : line_(name) {}
  [[nodiscard]] const std::string& line() const { return line_; }

  void text(std::string_view field) { line_.append(1, ',').append(field); }
  void number(double value, Print print) {
    std::string digits;
    append_decimal(digits, print.plus ? std::abs(value) : value, print.decimals);
    filled(digits, value < 0, print);
  }
  template <std::integral T>
  void number(T value, Print print = {}) {
    filled(std::to_string(value), value < 0, print);
  }
  template <class T, class... Prints>
  void number(const std::optional<T>& value, Prints... print) {
    value ? number(*value, print...) : text({});
  }
  template <class T, std::size_t N, class... Prints>
  void number(const std::array<T, N>& values, Prints... print) {
    for (const T& value : values) number(value, print...);
  }
  void letter(bool value, char yes, char no) { text({value ? &yes : &no, 1}); }

 private:
  void filled(const std::string& digits, bool is_negative, Print print) {
    text(print.plus ? (is_negative ? "-" : "+") : "");
    const std::size_t behind = print.decimals > 0 ? static_cast<std::size_t>(print.decimals) + 1 : 0;
    line_.append(std::max(print.digits + behind, digits.size()) - digits.size(), '0').append(digits);
  }

  std::string line_;
};

/// The content whose fields `lay_out(line, content)` states.
template <class Content, class LayOut>
[[nodiscard]] std::optional<Content> content_of(LineReader line, LayOut lay_out, Content content = {}) {
  lay_out(line, content);
  return line.are_good() ? std::optional(content) : std::nullopt;
}
/// `name` and the fields.
template <class Content, class LayOut>
[[nodiscard]] std::string line_of(std::string_view name, const Content& content, LayOut lay_out) {
  LineWriter line(name);
  lay_out(line, content);
  return line.line();
}

}  // namespace navcal::protocols

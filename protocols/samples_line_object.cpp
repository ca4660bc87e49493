// SPDX-License-Identifier: Apache-2.0
// The reader of flat JSON objects (RFC 8259). A library is not used here: docs/libraries.md says why.
#include <algorithm>
#include <cmath>

#include "protocols/decimal.h"
#include "protocols/samples_line.h"

namespace navcal::protocols::samples_line {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex_digit(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

/// Walks over a text; each take_... returns nullopt, or false, when the text goes on with something else.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : rest_(text) {}

  [[nodiscard]] bool is_at_end() const { return rest_.empty(); }
  void skip_blanks() {
    const std::size_t first = rest_.find_first_not_of(" \t\r\n");
    rest_.remove_prefix(std::min(first, rest_.size()));
  }
  bool take(char c) {
    skip_blanks();
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// The inside of a text in quotes.
  std::optional<std::string_view> take_text() {
    if (!take('"')) return std::nullopt;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const char c = rest_[i];
      if (c == '"') return take_inside(i);
      if (static_cast<unsigned char>(c) < ' ') return std::nullopt;
      if (c != '\\') continue;
      const std::size_t length = escape_length(i);
      if (length == 0) return std::nullopt;
      i += length - 1;
    }
    return std::nullopt;
  }
  /// Number, true, false or null.
  std::optional<Member> take_plain() {
    skip_blanks();
    for (const std::string_view word : {"true", "false", "null"}) {
      if (!rest_.starts_with(word)) continue;
      const Member member{{}, rest_.substr(0, word.size()), word == "null" ? Kind::null : Kind::boolean};
      rest_.remove_prefix(word.size());
      return member;
    }
    const std::size_t length = number_length();
    if (length == 0) return std::nullopt;
    const Member member{{}, rest_.substr(0, length), Kind::number};
    rest_.remove_prefix(length);
    return member;
  }
  std::optional<Member> take_scalar() {
    skip_blanks();
    if (!rest_.starts_with('"')) return take_plain();
    const auto text = take_text();
    return text ? std::optional(Member{{}, *text, Kind::text}) : std::nullopt;
  }
  /// A list of scalars, the inside of its brackets.
  std::optional<Member> take_list() {
    if (!take('[')) return std::nullopt;
    const char* const first = rest_.data();
    const auto inside = [&] { return std::string_view(first, static_cast<std::size_t>(rest_.data() - first)); };
    std::string_view before = inside();
    if (take(']')) return Member{{}, before, Kind::list};
    do {
      if (!take_scalar()) return std::nullopt;
      before = inside();
    } while (take(','));
    if (!take(']')) return std::nullopt;
    return Member{{}, before, Kind::list};
  }
  std::optional<Member> take_nested() {
    const char* const first = rest_.data();
    int depth = 0;
    do {
      skip_blanks();
      if (rest_.empty()) return std::nullopt;
      if (rest_.front() == '"') {
        if (!take_text()) return std::nullopt;
        continue;
      }
      depth += rest_.front() == '{' || rest_.front() == '['   ? 1
               : rest_.front() == '}' || rest_.front() == ']' ? -1
                                                              : 0;
      rest_.remove_prefix(1);
    } while (depth > 0);
    return Member{{}, {first, static_cast<std::size_t>(rest_.data() - first)}, Kind::nested};
  }
  std::optional<Member> take_value(bool nested) {
    skip_blanks();
    if (nested && (rest_.starts_with('[') || rest_.starts_with('{'))) return take_nested();
    return rest_.starts_with('[') ? take_list() : take_scalar();
  }

 private:
  std::string_view take_inside(std::size_t length) {
    const std::string_view inside = rest_.substr(0, length);
    rest_.remove_prefix(length + 1);
    return inside;
  }
  /// Length of the escape at `i`, with its backslash; 0 when it is none.
  [[nodiscard]] std::size_t escape_length(std::size_t i) const {
    if (i + 1 >= rest_.size()) return 0;
    if (std::string_view("\"\\/bfnrt").find(rest_[i + 1]) != std::string_view::npos) return 2;
    const bool is_unicode = rest_[i + 1] == 'u' && i + 6 <= rest_.size() &&
                            std::all_of(rest_.begin() + static_cast<std::ptrdiff_t>(i) + 2,
                                        rest_.begin() + static_cast<std::ptrdiff_t>(i) + 6, is_hex_digit);
    return is_unicode ? 6 : 0;
  }
  [[nodiscard]] std::size_t digits_at(std::size_t i) const {
    std::size_t n = 0;
    while (i + n < rest_.size() && is_digit(rest_[i + n])) ++n;
    return n;
  }
  /// 0 when no number begins here.
  [[nodiscard]] std::size_t number_length() const {
    std::size_t i = rest_.starts_with('-') ? 1 : 0;
    const std::size_t whole = digits_at(i);
    if (whole == 0 || (whole > 1 && rest_[i] == '0')) return 0;
    i += whole;
    if (i < rest_.size() && rest_[i] == '.') {
      const std::size_t decimals = digits_at(i + 1);
      if (decimals == 0) return 0;
      i += 1 + decimals;
    }
    if (i < rest_.size() && (rest_[i] == 'e' || rest_[i] == 'E')) {
      const bool has_sign = i + 1 < rest_.size() && (rest_[i + 1] == '-' || rest_[i + 1] == '+');
      const std::size_t exponent = digits_at(i + 1 + (has_sign ? 1 : 0));
      if (exponent == 0) return 0;
      i += 1 + (has_sign ? 1 : 0) + exponent;
    }
    return i;
  }

  std::string_view rest_;
};

std::optional<double> number_of(const Member& member, Bounds bounds) {
  if (member.kind != Kind::number) return std::nullopt;
  const auto value = real(member.value);
  return value && *value >= bounds.min && *value <= bounds.max ? value : std::nullopt;
}

std::uint32_t hex_of(std::string_view digits) { return integer<std::uint32_t>(digits, 16).value_or(0); }

void append_utf8(std::string& text, std::uint32_t point) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (point < 0x80) return put(point);
  if (point < 0x800) {
    put(0xC0 | point >> 6);
  } else {
    if (point < 0x10000) {
      put(0xE0 | point >> 12);
    } else {
      put(0xF0 | point >> 18);
      put(0x80 | (point >> 12 & 0x3F));
    }
    put(0x80 | (point >> 6 & 0x3F));
  }
  put(0x80 | (point & 0x3F));
}

constexpr std::uint32_t kReplacement = 0xFFFD;

/// The code point of the escape \uXXXX at `i`, or of a pair of them; `i` moves behind it.
std::uint32_t take_code_point(std::string_view escaped, std::size_t& i) {
  std::uint32_t point = hex_of(escaped.substr(i + 2, 4));
  i += 6;
  if (point < 0xD800 || point > 0xDFFF) return point;
  if (point > 0xDBFF || escaped.substr(i, 2) != "\\u") return kReplacement;
  const std::uint32_t low = hex_of(escaped.substr(i + 2, 4));
  if (low < 0xDC00 || low > 0xDFFF) return kReplacement;
  i += 6;
  point = 0x10000 + ((point - 0xD800) << 10) + (low - 0xDC00);
  return point;
}

std::string unescaped(std::string_view escaped) {
  std::string text;
  for (std::size_t i = 0; i < escaped.size();) {
    if (escaped[i] != '\\') {
      text += escaped[i++];
    } else if (escaped[i + 1] == 'u') {
      append_utf8(text, take_code_point(escaped, i));
    } else {
      constexpr std::string_view kLetters = "bfnrt", kMeaning = "\b\f\n\r\t";
      const std::size_t place = kLetters.find(escaped[i + 1]);
      text += place == std::string_view::npos ? escaped[i + 1] : kMeaning[place];
      i += 2;
    }
  }
  return text;
}

}  // namespace

std::optional<Object> Object::parse(Bytes line, bool nested) {
  Cursor cursor({reinterpret_cast<const char*>(line.data()), line.size()});
  Object object;
  if (!cursor.take('{')) return std::nullopt;
  if (!cursor.take('}')) {
    do {
      const auto key = cursor.take_text();
      if (!key || !cursor.take(':') || object.count_ == kMostMembers) return std::nullopt;
      const auto member = cursor.take_value(nested);
      if (!member) return std::nullopt;
      object.members_[object.count_++] = {*key, member->value, member->kind};
    } while (cursor.take(','));
    if (!cursor.take('}')) return std::nullopt;
  }
  cursor.skip_blanks();
  return cursor.is_at_end() ? std::optional(object) : std::nullopt;
}

const Member* Object::find(std::string_view key) const {
  for (std::size_t i = 0; i < count_; ++i) {
    if (members_[i].key == key) return &members_[i];
  }
  return nullptr;
}

const Member* Fields::find(std::string_view key, Kind kind) {
  const Member* const member = object_.find(key);
  if (member == nullptr || member->kind == Kind::null) return nullptr;
  if (member->kind == kind) return member;
  refuse();
  return nullptr;
}

std::optional<double> Fields::number(std::string_view key, Bounds bounds) {
  const Member* const member = find(key, Kind::number);
  if (member == nullptr) return std::nullopt;
  const auto value = number_of(*member, bounds);
  return value ? value : refused<double>();
}

std::optional<std::uint32_t> Fields::integer(std::string_view key, std::uint32_t max) {
  const auto value = number(key, {0, static_cast<double>(max)});
  if (!value) return std::nullopt;
  if (*value != std::floor(*value)) return refused<std::uint32_t>();
  return static_cast<std::uint32_t>(*value);
}

std::array<std::optional<double>, 3> Fields::three(std::string_view key, Bounds bounds) {
  std::array<std::optional<double>, 3> values;
  const Member* const member = find(key, Kind::list);
  if (member == nullptr) return values;
  Cursor cursor(member->value);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto element = i == 0 || cursor.take(',') ? cursor.take_scalar() : std::nullopt;
    if (!element) {
      refuse();
      return {};
    }
    if (element->kind == Kind::null) continue;
    values[i] = number_of(*element, bounds);
    if (!values[i]) refuse();
  }
  cursor.skip_blanks();
  if (!cursor.is_at_end()) refuse();
  return values;
}

std::optional<std::array<double, 3>> Fields::vector(std::string_view key, Bounds bounds) {
  if (find(key, Kind::list) == nullptr) return std::nullopt;
  const auto values = three(key, bounds);
  if (!values[0] || !values[1] || !values[2]) return refused<std::array<double, 3>>();
  return std::array{*values[0], *values[1], *values[2]};
}

std::optional<bool> Fields::boolean(std::string_view key) {
  const Member* const member = find(key, Kind::boolean);
  return member == nullptr ? std::nullopt : std::optional(member->value == "true");
}

std::optional<std::string> Fields::text(std::string_view key) {
  const Member* const member = find(key, Kind::text);
  return member == nullptr ? std::nullopt : std::optional(unescaped(member->value));
}

std::optional<std::int64_t> Fields::nanoseconds(std::string_view key) {
  const Member* const member = find(key, Kind::number);
  if (member == nullptr) return std::nullopt;
  const std::size_t point = std::min(member->value.find('.'), member->value.size());
  const std::string_view whole = member->value.substr(0, point);
  const std::string_view decimals = member->value.substr(std::min(point + 1, member->value.size()));
  constexpr std::size_t kMostDigits = 10;
  if (whole.size() > kMostDigits || !std::all_of(whole.begin(), whole.end(), is_digit) ||
      !std::all_of(decimals.begin(), decimals.end(), is_digit))
    return refused<std::int64_t>();
  std::int64_t ns = 0;
  for (const char c : whole) ns = ns * 10 + (c - '0');
  constexpr std::int64_t kEnd_s = 9'000'000'000;  // before the nanoseconds overflow, in the year 2255
  if (ns >= kEnd_s) return refused<std::int64_t>();
  for (std::size_t i = 0; i < 9; ++i) ns = ns * 10 + (i < decimals.size() ? decimals[i] - '0' : 0);
  return ns;
}

}  // namespace navcal::protocols::samples_line

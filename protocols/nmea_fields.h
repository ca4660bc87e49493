// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <optional>
#include <string_view>

#include "protocols/decimal.h"
#include "protocols/nmea.h"
#include "protocols/nmea_decimal.h"
#include "protocols/nmea_position.h"

namespace navcal::protocols::nmea {

/// Reads the fields of one sentence one after another and remembers whether each could be what it should be.
/// An empty field is nullopt and no fault.
class FieldReader {
 public:
  explicit FieldReader(const Sentence& sentence) : sentence_(sentence) {}

  /// The message, unless one of the fields read so far could not be what it should be.
  template <class Message>
  [[nodiscard]] std::optional<Message> if_in_range(const Message& message) const {
    return in_range_ ? std::optional<Message>(message) : std::nullopt;
  }
  [[nodiscard]] bool at_end() const { return next_ >= sentence_.size(); }
  std::string_view text() { return sentence_[next_++]; }
  void skip(std::size_t fields = 1) { next_ += fields; }
  void seek(std::size_t field) { next_ = field; }
  void refuse() { in_range_ = false; }

  std::optional<Decimal> decimal() {
    const std::string_view field = text();
    if (field.empty()) return std::nullopt;
    const auto number = parse_decimal(field);
    in_range_ = in_range_ && number;
    return number;
  }
  /// Within [low, high]; nullopt beyond, too.
  std::optional<Decimal> decimal(double low, double high) {
    const auto number = decimal();
    if (!number || (number->value() >= low && number->value() <= high)) return number;
    refuse();
    return std::nullopt;
  }
  /// A magnitude and the letter of its sign: `positive` or `negative`.
  std::optional<Decimal> signed_by_letter(char positive, char negative, double limit);

  template <std::unsigned_integral Number>
  std::optional<Number> count() {
    const std::string_view field = text();
    if (field.empty()) return std::nullopt;
    const auto number = integer<Number>(field);
    in_range_ = in_range_ && number;
    return number;
  }
  /// One character, 0 when empty.
  char letter() {
    const std::string_view field = text();
    if (field.size() > 1) refuse();
    return field.empty() ? '\0' : field[0];
  }
  std::optional<char> optional_letter() {
    const char c = letter();
    return c == '\0' ? std::nullopt : std::optional<char>(c);
  }

  std::optional<TimeOfDay> time_of_day();  ///< hhmmss[.s...]
  std::optional<LatLon> lat_lon();         ///< four fields: ddmm.m..., N or S, dddmm.m..., E or W

 private:
  std::optional<double> coordinate(std::size_t degree_digits, char positive, char negative, double limit);

  const Sentence& sentence_;
  std::size_t next_ = 0;
  bool in_range_ = true;
};

}  // namespace navcal::protocols::nmea

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/output.h"
#include "protocols/frame.h"
#include "protocols/nmea_decimal.h"
#include "protocols/utc.h"

namespace navcal::analysis {

/// Writes what was decoded, field by field: as a JSON object a line (docs/cli.md, `decode`), where what is absent
/// is null, or as a line for people, where it is left out.
class FieldWriter {
 public:
  enum class Format : std::uint8_t { json, text };

  /// `pivot`: dates before it are moved up by whole epochs of 1024 weeks; nullopt: dates as sent.
  FieldWriter(base::Output& output, Format format, std::optional<protocols::Date> pivot = {})
      : output_(output), json_(format == Format::json), pivot_(pivot) {}
  [[nodiscard]] const std::optional<protocols::Date>& pivot() const { return pivot_; }

  void begin_frame(std::string_view protocol, const protocols::Frame& frame);
  /// The frame has a decoder, so far.
  [[nodiscard]] bool has_fields() const { return has_fields_; }
  void end_frame() { output_.append(json_ ? std::string_view("}\n") : std::string_view("\n")); }

  template <std::integral Integer>
  requires(!std::same_as<Integer, bool> && !std::same_as<Integer, char>) void number(std::string_view key,
                                                                                     Integer value) {
    begin_field(key);
    write_integer(static_cast<std::int64_t>(value));
  }
  /// Writes a number with at most `decimals` decimals, without trailing zeros.
  void number(std::string_view key, double value, int decimals) {
    begin_field(key);
    write_number(value, decimals);
  }
  /// Writes a number with the fewest digits that identify it exactly.
  void number(std::string_view key, double value);
  void number(std::string_view key, const protocols::nmea::Decimal& value) {
    begin_field(key);
    write_decimal(value);
  }
  template <class Number, class... Decimals>
  void number(std::string_view key, const std::optional<Number>& value, Decimals... decimals) {
    if (!value) return null(key);
    number(key, *value, decimals...);
  }
  void flag(std::string_view key, bool value) {
    begin_field(key);
    output_.append(value ? std::string_view("true") : std::string_view("false"));
  }
  /// Any bytes: those that are not ASCII are taken as Latin-1, so that the JSON is always valid.
  void text(std::string_view key, std::string_view value);
  /// A letter; '\0' is null.
  void letter(std::string_view key, char value);
  void letter(std::string_view key, std::optional<char> value) { letter(key, value.value_or('\0')); }
  void null(std::string_view key);
  /// A number, true, false or null, as it was sent.
  void written(std::string_view key, std::string_view json) {
    begin_field(key);
    output_.append(json);
  }

  /// ISO 8601, UTC, as many decimals as it takes in steps of three.
  void time(std::string_view key, const protocols::Date& date, const protocols::TimeOfDay& time);
  void time_of_day(std::string_view key, const protocols::TimeOfDay& time);

  // Lists of numbers and of objects; elements are fields with an empty key.
  void begin_list(std::string_view key) { open(key, '['); }
  void end_list() { close(']'); }
  void begin_object(std::string_view key = {}) { open(key, '{'); }
  void end_object() { close('}'); }
  template <class Numbers, class... Decimals>
  void numbers(std::string_view key, const Numbers& values, Decimals... decimals) {
    begin_list(key);
    for (const auto& value : values) number({}, value, decimals...);
    end_list();
  }
  template <class Numbers, class... Decimals>
  void numbers(std::string_view key, const std::optional<Numbers>& values, Decimals... decimals) {
    if (!values) return null(key);
    numbers(key, *values, decimals...);
  }
  /// One object for each element; `write` writes its fields.
  template <class Elements, class Write>
  void objects(std::string_view key, const Elements& elements, Write write) {
    begin_list(key);
    for (const auto& element : elements) {
      begin_object();
      write(element);
      end_object();
    }
    end_list();
  }

 private:
  void begin_field(std::string_view key);
  void open(std::string_view key, char bracket);
  void close(char bracket);
  void write_integer(std::int64_t value);
  void write_number(double value, int decimals);
  void write_decimal(const protocols::nmea::Decimal& value);
  void write_time(const protocols::TimeOfDay& time);

  base::Output& output_;
  bool json_;
  std::optional<protocols::Date> pivot_;
  bool has_fields_ = false;
  bool first_ = true;  // of the frame, list or object: no comma before it
};

}  // namespace navcal::analysis

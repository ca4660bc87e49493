// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocols/described/checksum.h"
#include "protocols/described/meaning.h"
#include "protocols/frame.h"

/// What a description states, as plain data. The reader (config/described/) has checked it: whoever makes one by
/// hand must keep to the same rules.
namespace navcal::protocols::described {

/// No frame is longer: a wrong length must not hold the parser for long.
inline constexpr std::size_t kMaxFrameLength = 1024;

enum class ByteOrder : std::uint8_t { little, big };

/// How a number is written. From decimal on they are of text: `nmea` is decimal as NMEA 0183 has it, without
/// exponent and without blanks.
enum class Type : std::uint8_t {
  u8,
  i8,
  u16,
  i16,
  u24,
  i24,
  u32,
  i32,
  f32,
  f64,
  decimal,
  hex,
  degrees_minutes,
  nmea
};

/// "u16".
[[nodiscard]] std::string_view name_of(Type type);
[[nodiscard]] std::optional<Type> type_named(std::string_view name);
/// Bytes of a number in a binary frame; 0 for the types of text.
[[nodiscard]] std::size_t size_of(Type type);

/// One number of a frame. Its value in `unit` is (raw * scale - zero) / sensitivity.
struct Field {
  std::string name;  ///< shown to people: the description's own, else that of the meaning
  Meaning meaning = Meaning::none;
  std::string unit;  ///< of the value, as the description states it
  Type type = Type::u8;
  /// Binary: offset of its first byte in the frame. Text: number of the field, from 1; 0 where `key` names it.
  std::uint16_t at = 0;
  std::string key;  ///< text: the word before the sign, as in `T=12.3`
  ByteOrder byte_order = ByteOrder::little;
  std::uint8_t first_bit = 0, bits = 0;  ///< part of an unsigned number; 0 bits: all of it
  /// Text: number of the field with N, S, E or W (or + and -); S, W and - make the value negative; 0: there is
  /// none.
  std::uint16_t sign_at = 0;
  double scale = 1, zero = 0, sensitivity = 1;
  double factor = 1, offset = 0;    ///< from `unit` to the unit of samples
  std::optional<double> absent;     ///< raw number by which the device says that it has no value
  std::optional<double> low, high;  ///< in `unit`: a frame with a value beyond them is refused
  std::optional<double> std;        ///< standard error, in the unit of samples

  bool operator==(const Field&) const = default;
};

/// Length of a binary frame, everything counted.
struct Length {
  std::size_t fixed = 0;  ///< 0: the frame states it at `at`: number * times + add
  std::uint16_t at = 0;
  Type type = Type::u8;
  ByteOrder byte_order = ByteOrder::little;
  int times = 1, add = 0;
  std::size_t longest = kMaxFrameLength;

  bool operator==(const Length&) const = default;
};

/// Where a checksum stands and what it covers: bytes from `from` up to `to`, `to` excluded. Negative numbers count
/// from the end of the frame. In a text the checksum is hexadecimal, stands behind `mark`, and covers everything
/// from `from` up to the mark.
struct Checksum {
  Sum sum = Sum::none;
  int from = 0, to = 0, at = 0;
  ByteOrder byte_order = ByteOrder::little;
  char mark = '*';

  bool operator==(const Checksum&) const = default;
};

/// Bytes that frames of this kind always have.
struct Constant {
  std::uint16_t at = 0;
  std::string bytes;

  bool operator==(const Constant&) const = default;
};

/// One kind of frame.
struct FrameKind {
  FrameId id;
  std::string start;  ///< bytes or characters that it begins with; empty only in a text
  std::vector<Constant> constants;
  Length length;
  Checksum checksum;
  char separator = ',';   ///< of a text; a blank stands for any number of blanks and tabs
  char end = '\n';        ///< of a text; <CR> before <LF> belongs to it
  char key_sign = '=';    ///< of a text, between key and number
  std::size_t count = 0;  ///< fields that a text must have; 0: any number
  std::vector<Field> fields;

  bool operator==(const FrameKind&) const = default;
};

struct Description {
  std::string name;  ///< of the device, for people
  bool is_text = false;
  std::optional<int> baud;
  std::optional<double> rate_Hz, latency_s, latency_std_s;
  std::vector<std::string> start_up;  ///< what is sent to the device when its port is opened
  std::vector<FrameKind> kinds;

  bool operator==(const Description&) const = default;
};

/// Whether any frame has a value of this meaning.
[[nodiscard]] bool has(const Description& description, Meaning meaning);

/// Least number of bytes that a binary frame of this kind needs for its start, length, constants, checksum and
/// covered bytes.
[[nodiscard]] std::size_t least_length(const FrameKind& kind);

}  // namespace navcal::protocols::described

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "protocols/decimal.h"
#include "protocols/described/description.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::described {
namespace encoding {

using Buffer = std::vector<std::uint8_t>;

inline std::size_t from_front(int place, std::size_t length) {
  return place < 0 ? length - static_cast<std::size_t>(-place) : static_cast<std::size_t>(place);
}

inline double raw_for(const Field& field, double value) {
  if (std::isnan(value)) return field.absent.value_or(0);
  return (value * field.sensitivity + field.zero) / field.scale;
}

inline void put_bytes(std::uint8_t* p, std::uint64_t value, std::size_t size, ByteOrder order) {
  for (std::size_t i = 0; i < size; ++i)
    p[i] = static_cast<std::uint8_t>(value >> 8 * (order == ByteOrder::big ? size - 1 - i : i));
}

inline std::uint64_t get_bytes(const std::uint8_t* p, std::size_t size, ByteOrder order) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value |= std::uint64_t{p[i]} << 8 * (order == ByteOrder::big ? size - 1 - i : i);
  return value;
}

/// The nearest number that a type holds, as its bytes hold it.
inline std::uint64_t bits_of(double raw, Type type) {
  if (type == Type::f32) return std::bit_cast<std::uint32_t>(static_cast<float>(raw));
  if (type == Type::f64) return std::bit_cast<std::uint64_t>(raw);
  const auto bits = static_cast<int>(8 * size_of(type));
  const bool is_signed = type == Type::i8 || type == Type::i16 || type == Type::i24 || type == Type::i32;
  const double low = is_signed ? -std::ldexp(1, bits - 1) : 0;
  const double high = (is_signed ? std::ldexp(1, bits - 1) : std::ldexp(1, bits)) - 1;
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::clamp(std::round(raw), low, high)));
}

inline void put_field(const Field& field, double value, Buffer& frame) {
  std::uint8_t* const p = frame.data() + field.at;
  const std::size_t size = size_of(field.type);
  std::uint64_t bits = bits_of(raw_for(field, value), field.type);
  if (field.bits > 0) {
    const std::uint64_t mask = ((std::uint64_t{1} << field.bits) - 1) << field.first_bit;
    bits = (get_bytes(p, size, field.byte_order) & ~mask) | (bits << field.first_bit & mask);
  }
  put_bytes(p, bits, size, field.byte_order);
}

inline void put_text(std::string_view text, std::size_t at, Buffer& frame) {
  std::copy(text.begin(), text.end(), frame.begin() + static_cast<std::ptrdiff_t>(at));
}

inline std::size_t binary_length(const FrameKind& kind) {
  if (kind.length.fixed != 0) return kind.length.fixed;
  std::size_t end = least_length(kind);
  const std::size_t tail = kind.checksum.at < 0 ? static_cast<std::size_t>(-kind.checksum.at) : 0;
  for (const Field& field : kind.fields) end = std::max(end, field.at + size_of(field.type) + tail);
  // Lengths that come in steps: the next one that the frame can state.
  const auto beyond = static_cast<int>(end) - kind.length.add;
  const int steps = std::max(0, (beyond + kind.length.times - 1) / kind.length.times);
  return static_cast<std::size_t>(steps * kind.length.times + kind.length.add);
}

inline Buffer encode_binary(const FrameKind& kind, std::span<const double> values) {
  Buffer frame(binary_length(kind));
  for (std::size_t i = 0; i < kind.fields.size(); ++i) put_field(kind.fields[i], values[i], frame);
  put_text(kind.start, 0, frame);
  for (const Constant& constant : kind.constants) put_text(constant.bytes, constant.at, frame);
  if (kind.length.fixed == 0) {
    const auto stated = (static_cast<int>(frame.size()) - kind.length.add) / kind.length.times;
    put_bytes(frame.data() + kind.length.at, static_cast<std::uint64_t>(stated), size_of(kind.length.type),
              kind.length.byte_order);
  }
  const Checksum& checksum = kind.checksum;
  if (checksum.sum == Sum::none) return frame;
  const std::size_t from = from_front(checksum.from, frame.size()), to = from_front(checksum.to, frame.size());
  put_bytes(frame.data() + from_front(checksum.at, frame.size()),
            sum_of(checksum.sum, Bytes(frame).subspan(from, to - from)), size_of(checksum.sum),
            checksum.byte_order);
  return frame;
}

inline std::string printed(const Field& field, double value) {
  if (std::isnan(value) && !field.absent) return {};
  const double raw = raw_for(field, value);
  const double size = field.sign_at > 0 ? std::abs(raw) : raw;
  char digits[64];
  if (field.type == Type::hex) {
    const auto number = static_cast<std::int64_t>(std::clamp(std::round(size), -1e15, 1e15));
    const char* const end = std::to_chars(digits, digits + sizeof digits, number, 16).ptr;
    return std::string(digits, static_cast<std::size_t>(end - digits));
  }
  if (field.type == Type::degrees_minutes) {
    const double degrees = std::floor(size);
    std::string text;
    append_decimal(text, 100 * degrees + std::min(60 * (size - degrees), 59.9999), 4);
    return text;
  }
  const char* const end = std::to_chars(digits, digits + sizeof digits, size, std::chars_format::general, 12).ptr;
  return std::string(digits, static_cast<std::size_t>(end - digits));
}

inline Buffer encode_text(const FrameKind& kind, std::span<const double> values) {
  std::map<std::size_t, std::string> numbered;
  std::vector<std::string> keyed;
  for (std::size_t i = 0; i < kind.fields.size(); ++i) {
    const Field& field = kind.fields[i];
    const std::string text = printed(field, values[i]);
    if (field.at == 0) {
      if (!text.empty()) keyed.push_back(field.key + kind.key_sign + text);
      continue;
    }
    numbered[field.at] = text;
    if (field.sign_at > 0) numbered[field.sign_at] = raw_for(field, values[i]) < 0 ? "S" : "N";
  }
  const std::size_t last = numbered.empty() ? 0 : numbered.rbegin()->first;
  std::vector<std::string> fields;
  for (std::size_t i = 1; i <= last; ++i) fields.push_back(numbered[i]);
  fields.insert(fields.end(), keyed.begin(), keyed.end());
  if (fields.size() < kind.count) fields.resize(kind.count);
  std::string line = kind.start;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    // Between blanks nothing can be empty.
    const bool needs_filling = kind.separator == ' ' && fields[i].empty();
    line += (i > 0 ? std::string(1, kind.separator) : std::string()) + (needs_filling ? "0" : fields[i]);
  }
  if (kind.checksum.sum != Sum::none) {
    const auto from = static_cast<std::size_t>(kind.checksum.from);
    const Bytes covered(reinterpret_cast<const std::uint8_t*>(line.data()) + from, line.size() - from);
    const std::uint32_t sum = sum_of(kind.checksum.sum, covered);
    line += kind.checksum.mark;
    append_hex(line, sum, 2 * size_of(kind.checksum.sum));
  }
  line += kind.end == '\n' ? std::string("\r\n") : std::string(1, kind.end);
  return {line.begin(), line.end()};
}

}  // namespace encoding

/// A frame with these values, in the units of the description and in the order of its fields; NaN writes what
/// means absent where the description states it, else 0, or nothing in a text. Numbers are rounded to what their
/// type can hold. What the description says nothing of is 0. A frame that states its length has the least one that
/// holds all fields.
[[nodiscard]] inline std::vector<std::uint8_t> encode(const Description& description, const FrameKind& kind,
                                                      std::span<const double> values) {
  return description.is_text ? encoding::encode_text(kind, values) : encoding::encode_binary(kind, values);
}

}  // namespace navcal::protocols::described

// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/reading.h"

#include <cmath>

#include "protocols/described/text.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::described {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
/// Beyond it, scale and unit could lead out of what a double holds.
constexpr double kLargestRaw = 1e200;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// -1 for S, W and -; 1 for N, E, + and nothing; 0 for anything else.
double sign_of(std::string_view text) {
  if (text.empty() || text == "N" || text == "E" || text == "+") return 1;
  return text == "S" || text == "W" || text == "-" ? -1 : 0;
}

/// The text behind `key` and the sign in one of the fields; empty when there is none.
std::string_view value_of_key(const TextFields& fields, std::string_view key, char sign) {
  for (std::size_t i = 1; i <= fields.count; ++i) {
    std::string_view field = without_blanks(fields[i]);
    if (!field.starts_with(key)) continue;
    field.remove_prefix(key.size());
    if (!field.starts_with(sign)) continue;
    field.remove_prefix(1);
    return without_blanks(field);
  }
  return {};
}

}  // namespace

FrameReader::FrameReader(const FrameKind& kind, bool is_text) : kind_(kind, is_text) {
  if (!is_text && kind.checksum.sum != Sum::none && kind.checksum.at < 0)
    tail_ = static_cast<std::size_t>(-kind.checksum.at);
  for (const Field& field : kind.fields) fields_.push_back(plan_of(field));
}

FrameReader::FieldPlan FrameReader::plan_of(const Field& field) {
  FieldPlan plan;
  plan.at = field.at;
  plan.type = field.type;
  plan.end = static_cast<std::uint16_t>(field.at + size_of(field.type));
  plan.is_big = field.byte_order == ByteOrder::big;
  plan.is_scaled = field.scale != 1 || field.zero != 0 || field.sensitivity != 1;
  plan.is_absent_marked = field.absent.has_value();
  plan.absent = field.absent.value_or(0);
  plan.is_offset = field.offset != 0;
  plan.shift = field.first_bit;
  if (field.bits > 0) plan.mask = static_cast<std::uint32_t>((std::uint64_t{1} << field.bits) - 1);
  plan.sign_at = field.sign_at;
  plan.scale = field.scale;
  plan.zero = field.zero;
  plan.sensitivity = field.sensitivity;
  plan.factor = field.factor;
  plan.offset = field.offset;
  plan.low = field.low.value_or(-kUnbounded);
  plan.high = field.high.value_or(kUnbounded);
  plan.least = info_of(field.meaning).low;
  plan.greatest = info_of(field.meaning).high;
  plan.key = field.key;
  return plan;
}

inline double FrameReader::raw_of(const FieldPlan& field, const std::uint8_t* frame) {
  const std::uint8_t* const p = frame + field.at;
  switch (field.type) {
    case Type::f32: {
      const float value = field.is_big ? get_be<float>(p) : get_le<float>(p);
      return std::isfinite(value) ? double{value} : kNoValue;
    }
    case Type::f64: {
      const double value = field.is_big ? get_be<double>(p) : get_le<double>(p);
      return std::abs(value) <= kLargestRaw ? value : kNoValue;
    }
    case Type::u8:
      if (field.mask != 0) return (*p >> field.shift) & field.mask;
      return *p;
    case Type::u16:
      if (field.mask == 0) return field.is_big ? get_be<std::uint16_t>(p) : get_le<std::uint16_t>(p);
      break;
    case Type::i16: return field.is_big ? get_be<std::int16_t>(p) : get_le<std::int16_t>(p);
    default: break;
  }
  const std::int64_t number = integer_at(p, field.type, field.is_big);
  if (field.mask != 0) return static_cast<double>(static_cast<std::uint32_t>(number) >> field.shift & field.mask);
  return static_cast<double>(number);
}

template <class Use>
bool FrameReader::for_each_value(Bytes frame, Use use) const {
  if (kind_.is_text) return for_each_text_value(frame, use);
  const std::uint8_t* const bytes = frame.data();
  const std::size_t limit = frame.size() - tail_;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const FieldPlan& field = fields_[i];
    use(field, i, field.end <= limit ? field.value(raw_of(field, bytes)) : kNoValue);
  }
  return true;
}

template <class Use>
bool FrameReader::for_each_text_value(Bytes frame, Use use) const {
  TextFields texts;
  split(kind_.separator, body_of(kind_, frame), texts);
  bool all_are_numbers = true;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const FieldPlan& field = fields_[i];
    const std::string_view text = field.at > 0 ? texts[field.at] : value_of_key(texts, field.key, kind_.key_sign);
    double value = kNoValue;
    const bool is_empty = field.type == Type::nmea ? text.empty() : without_blanks(text).empty();
    if (!is_empty) {
      const auto raw = number_of(text, field.type);
      const double sign = field.sign_at > 0 ? sign_of(without_blanks(texts[field.sign_at])) : 1;
      if (!raw || std::abs(*raw) > kLargestRaw || sign == 0) {
        all_are_numbers = false;
      } else {
        value = field.value(sign < 0 ? -*raw : *raw);
      }
    }
    use(field, i, value);
  }
  return all_are_numbers;
}

bool FrameReader::read(Bytes frame, std::span<double> values) const {
  bool is_possible = true;
  const bool are_numbers = for_each_value(frame, [&](const FieldPlan& field, std::size_t i, double value) {
    const double sample = field.as_sample(value);
    values[i] = sample;
    // Written so that an absent value, NaN, is within its bounds.
    const bool is_beyond =
        value < field.low || value > field.high || sample < field.least || sample > field.greatest;
    is_possible = is_possible && !is_beyond;
  });
  return is_possible && are_numbers;
}

void FrameReader::read_plain(Bytes frame, std::span<double> values) const {
  (void)for_each_value(frame, [&](const FieldPlan&, std::size_t i, double value) { values[i] = value; });
}

}  // namespace navcal::protocols::described

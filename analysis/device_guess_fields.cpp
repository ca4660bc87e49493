// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/device_guess_parts.h"
#include "protocols/described/plan.h"
#include "protocols/wire_fields.h"

namespace navcal::analysis {
namespace {

using protocols::Bytes;
using protocols::described::ByteOrder;
using NumberType = protocols::described::Type;

constexpr std::size_t kFramesSeen = 2000;
/// A value that is measured moves little from frame to frame, beside the range of its type.
constexpr double kSmooth = 0.08;

/// One reading of the bytes at a place.
struct Reading {
  NumberType type = NumberType::u8;
  ByteOrder order = ByteOrder::little;
  double roughness = 1;  ///< mean step from frame to frame, beside the range of the type
  double low = 0, high = 0;
  std::size_t changes = 0;
};

double range_of(NumberType type) { return std::ldexp(1, static_cast<int>(8 * size_of(type))); }

double number_at(Bytes frame, std::size_t at, NumberType type, bool is_big) {
  const std::uint8_t* const p = frame.data() + at;
  if (type == NumberType::f32)
    return static_cast<double>(is_big ? protocols::get_be<float>(p) : protocols::get_le<float>(p));
  if (type == NumberType::f64) return is_big ? protocols::get_be<double>(p) : protocols::get_le<double>(p);
  return static_cast<double>(protocols::described::integer_at(p, type, is_big));
}

class Columns {
 public:
  Columns(const Framing& framing, std::size_t first, std::size_t last) : first_(first), last_(last) {
    for (const Bytes frame : framing.frames) {
      if (frames_.size() < kFramesSeen && frame.size() >= last) frames_.push_back(frame);
    }
  }

  std::string lines() {
    std::string out;
    for (std::size_t at = first_; at < last_;) {
      const Reading reading = best_at(at);
      out += line(at, reading);
      at += size_of(reading.type);
    }
    return out;
  }

 private:
  [[nodiscard]] Reading read(std::size_t at, NumberType type, ByteOrder order) const {
    Reading reading{type, order, 0, 0, 0, 0};
    double before = 0;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const double value = number_at(frames_[i], at, type, order == ByteOrder::big);
      reading.low = i == 0 ? value : std::min(reading.low, value);
      reading.high = i == 0 ? value : std::max(reading.high, value);
      if (i > 0 && value != before) ++reading.changes;
      if (i > 0)
        reading.roughness += std::abs(value - before) / range_of(type) / static_cast<double>(frames_.size() - 1);
      before = value;
    }
    return reading;
  }

  [[nodiscard]] bool is_constant(std::size_t at) const {
    return std::ranges::all_of(frames_, [&](Bytes frame) { return frame[at] == frames_.front()[at]; });
  }

  /// Numbers of floating point are of ordinary size; other bytes seldom make such.
  [[nodiscard]] bool is_float(std::size_t at, NumberType type, ByteOrder order) const {
    constexpr double kSmallest = 1e-7, kLargest = 1e7;
    std::size_t ordinary = 0;
    for (const Bytes frame : frames_) {
      const double size = std::abs(number_at(frame, at, type, order == ByteOrder::big));
      if (!(size <= kLargest)) return false;
      if (size >= kSmallest) ++ordinary;
    }
    return ordinary * 2 > frames_.size() && read(at, type, order).changes > 0;
  }

  /// Counts by one, whatever its size.
  [[nodiscard]] bool is_counter(std::size_t at) const {
    std::size_t steps = 0;
    for (std::size_t i = 0; i + 1 < frames_.size(); ++i)
      steps += static_cast<std::uint8_t>(frames_[i][at] + 1) == frames_[i + 1][at] ? 1U : 0U;
    return frames_.size() > 2 && static_cast<double>(steps) > 0.9 * static_cast<double>(frames_.size() - 1);
  }

  [[nodiscard]] Reading best_at(std::size_t at) const {
    const Reading byte = read(at, NumberType::u8, ByteOrder::little);
    if (is_counter(at)) return byte;
    const auto fits = [&](NumberType type) { return at + size_of(type) <= last_; };
    for (const NumberType type : {NumberType::f64, NumberType::f32}) {
      for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
        if (fits(type) && is_float(at, type, order)) return read(at, type, order);
      }
    }
    // A byte that never changes is a state or unused rather than the upper half of a number.
    if (!fits(NumberType::u16) || is_constant(at)) return byte;
    Reading best = byte;
    best.roughness = kSmooth;
    for (const NumberType type : {NumberType::u16, NumberType::i16}) {
      for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
        const Reading reading = read(at, type, order);
        if (reading.changes > 0 && reading.roughness < best.roughness) best = reading;
      }
    }
    return best;
  }

  [[nodiscard]] static std::string line(std::size_t at, const Reading& reading) {
    const std::string order = size_of(reading.type) == 1        ? ""
                              : reading.order == ByteOrder::big ? ", byte_order = \"big\""
                                                                : ", byte_order = \"little\"";
    const std::string seen = reading.changes == 0 ? fmt::format("always {:g}", reading.low)
                                                  : fmt::format("{:g} to {:g}", reading.low, reading.high);
    return fmt::format("  {{ name = \"at_{}\", at = {}, type = \"{}\"{} }},  # {}\n", at, at,
                       name_of(reading.type), order, seen);
  }

  std::size_t first_, last_;
  std::vector<Bytes> frames_;
};

}  // namespace

std::string field_lines(const Framing& framing, const std::optional<protocols::described::Checksum>& checksum) {
  constexpr std::size_t kMostFields = 100;
  std::size_t shortest = framing.frames.front().size();
  for (const Bytes frame : framing.frames) shortest = std::min(shortest, frame.size());
  const std::size_t tail = checksum ? static_cast<std::size_t>(-checksum->at) : 0;
  std::size_t first = framing.sync.size();
  const auto& length = framing.length;
  if (length.fixed == 0) first = std::max(first, length.at + size_of(length.type));
  const std::size_t last = std::min(shortest > tail ? shortest - tail : 0, first + kMostFields);
  return last > first ? Columns(framing, first, last).lines() : std::string();
}

}  // namespace navcal::analysis

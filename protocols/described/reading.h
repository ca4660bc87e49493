// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "protocols/described/plan.h"

namespace navcal::protocols::described {

/// Reads the numbers of the frames of one kind.
class FrameReader {
 public:
  FrameReader(const FrameKind& kind, bool is_text);

  [[nodiscard]] std::size_t size() const { return fields_.size(); }
  [[nodiscard]] const KindPlan& plan() const { return kind_; }

  /// Values of an intact frame in the units of samples, in the order of the description's fields; NaN: the frame
  /// has none. False when a value cannot be (its field's bounds, those of its meaning, or text that is no number).
  /// `values` has size() elements; the value that cannot be is among them where it is a number.
  [[nodiscard]] bool read(Bytes frame, std::span<double> values) const;
  /// The same in the units of the description, without any bounds.
  void read_plain(Bytes frame, std::span<double> values) const;

 private:
  struct FieldPlan {
    std::uint16_t at = 0, end = 0;
    Type type = Type::u8;
    bool is_big = false;
    bool is_scaled = false, is_absent_marked = false, is_offset = false;
    std::uint8_t shift = 0;
    std::uint32_t mask = 0;
    std::uint16_t sign_at = 0;
    double scale = 1, zero = 0, sensitivity = 1, factor = 1, offset = 0, absent = 0;
    double low = 0, high = 0;        ///< in the description's unit
    double least = 0, greatest = 0;  ///< in the unit of samples
    std::string key;

    [[nodiscard]] double value(double raw) const {
      if (is_absent_marked && raw == absent) return std::numeric_limits<double>::quiet_NaN();
      return is_scaled ? (raw * scale - zero) / sensitivity : raw;
    }
    [[nodiscard]] double as_sample(double value) const {
      return is_offset ? value * factor + offset : value * factor;
    }
  };

  static FieldPlan plan_of(const Field& field);
  static double raw_of(const FieldPlan& field, const std::uint8_t* frame);
  /// `use(field, index, value)` with the values in the description's unit. False when a text is no number.
  template <class Use>
  bool for_each_value(Bytes frame, Use use) const;
  template <class Use>
  bool for_each_text_value(Bytes frame, Use use) const;

  KindPlan kind_;
  std::size_t tail_ = 0;  ///< bytes at the end of a binary frame that belong to its checksum
  std::vector<FieldPlan> fields_;
};

}  // namespace navcal::protocols::described

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "protocols/described/plan.h"

/// Fields of the lines of described devices.
namespace navcal::protocols::described {

/// A line has at most so many fields; what stands behind them is not looked at.
inline constexpr std::size_t kMaxTextFields = 128;

/// A line without its end, and without the <CR> before <LF>.
[[nodiscard]] Bytes without_end(const KindPlan& kind, Bytes line);
/// What stands between the start characters and the mark of the checksum, or the end of the line.
[[nodiscard]] Bytes body_of(const KindPlan& kind, Bytes line);
[[nodiscard]] std::size_t count_fields(const KindPlan& kind, Bytes body);

/// The fields of a body; views into its bytes.
struct TextFields {
  std::array<std::string_view, kMaxTextFields> fields;
  std::size_t count = 0;

  /// Field with this number, from 1; empty beyond the last.
  [[nodiscard]] std::string_view operator[](std::size_t number) const {
    return number >= 1 && number <= count ? fields[number - 1] : std::string_view{};
  }
};
void split(char separator, Bytes body, TextFields& into);

/// The text without the blanks and tabs around it.
[[nodiscard]] std::string_view without_blanks(std::string_view text);

/// The whole of a field as a number of this type: decimal with sign, point and exponent; hexadecimal with or
/// without 0x; degrees and minutes, `4807.038`, in degrees. Blanks around it do not count, but for the type nmea.
/// nullopt: it is none.
[[nodiscard]] std::optional<double> number_of(std::string_view text, Type type);

}  // namespace navcal::protocols::described

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "protocols/frame.h"

namespace navcal::protocols::tcm2 {

/// The letters of the fields of a word, in their order.
inline constexpr std::string_view kFieldLetters = "CPRXYZTE";

/// Errors in a word (OR-ed) or in a refusal; others are unknown faults (ICD section 1).
namespace error {
inline constexpr std::uint32_t kDistortion = 0x001;
inline constexpr std::uint32_t kInclinometerOutOfRange = 0x002;  ///< heading and tilt are void
inline constexpr std::uint32_t kMagnetometerOutOfRange = 0x004;
inline constexpr std::uint32_t kBadCommand = 0x010;
inline constexpr std::uint32_t kBadParameter = 0x040;
}  // namespace error

/// A data word as the device says it. A field that is switched off is absent. Whether angles are degrees or mils
/// and the temperature C or F is configuration, not in the word.
struct Word {
  std::optional<double> heading{}, pitch{}, roll{};
  std::optional<double> x{}, y{}, z{};  ///< uT; body axes x forward, y starboard, z down
  std::optional<double> temperature{};
  std::optional<std::uint32_t> error{};  ///< the raw code; there only while an error stands

  /// The field vector, if all three components are there.
  [[nodiscard]] std::optional<std::array<double, 3>> field() const {
    if (!x || !y || !z) return std::nullopt;
    return std::array<double, 3>{*x, *y, *z};
  }
  bool operator==(const Word&) const = default;
};

/// Decimals that the device prints.
struct WordFormat {
  int angles = 1;
  int field = 2;
  int temperature = 1;
};

/// Decodes an intact WORD frame; nullopt if its text does not consist of fields in their order. A colon before
/// `E`, which some firmware prints, is skipped.
[[nodiscard]] std::optional<Word> decode_word(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_word(const Word& word, const WordFormat& format = {});

/// Heading of an intact HCHDM frame, degrees; nullopt when it is empty or not a number.
[[nodiscard]] std::optional<double> decode_hchdm(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_hchdm(double heading_deg);

}  // namespace navcal::protocols::tcm2

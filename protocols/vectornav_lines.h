// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/vectornav.h"

/// Lines of a VectorNav sensor: measurements, and the reading and writing of its registers (ICD section 12).
namespace navcal::protocols::vectornav {

/// VNYMR, VNYPR, VNIMU, VNMAG, VNACC, VNGYR, VNMAR; nullopt for another line or when a field is no number. The
/// values of VNIMU are uncompensated.
[[nodiscard]] std::optional<Reading> decode_line(Bytes frame);
/// VNYMR; values that are absent are sent as 0.
[[nodiscard]] std::vector<std::uint8_t> encode_line(const Reading& reading);

// Registers that the start-up needs.
inline constexpr unsigned kModel = 1, kFirmware = 4, kAsyncType = 6, kAsyncRate = 7, kBinaryOutput1 = 75;

/// A register with its values as text: sent to the sensor to write it (VNWRG) or, without values, to read it
/// (VNRRG); the sensor answers with the same line and the values.
struct Register {
  bool write = false;
  unsigned number = 0;
  std::string values;  ///< separated by commas
  bool operator==(const Register&) const = default;
};
[[nodiscard]] std::optional<Register> decode_register(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_register(const Register& content);

/// VNERR: the answer to a command that cannot be carried out.
[[nodiscard]] std::optional<std::uint8_t> decode_error(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_error(std::uint8_t code);
/// "invalid checksum", "insufficient baud rate", ...; "unknown" for a code without a meaning here.
[[nodiscard]] std::string_view meaning_of(std::uint8_t error);

}  // namespace navcal::protocols::vectornav

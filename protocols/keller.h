// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// Keller pressure transmitters (series 30, 33, 35, 36, 40, 41 and others) on their RS-485 bus: address, function,
/// data, CRC-16/MODBUS with the upper byte first. Manual, not at hand (ICD): "Description of the Communication
/// Protocol" (ICD section 15). No capture was at hand. The transmitter speaks only when it is asked. Converters of
/// two-wire lines return what the host says: requests are therefore frames as well.
namespace navcal::protocols::keller {

inline constexpr std::uint8_t kInitialise = 48, kReadChannel = 73, kRefused = 0x80;
/// An address to which each transmitter answers that is alone on its bus.
inline constexpr std::uint8_t kAnyAddress = 250;
/// Channels: 0 calculated, 1 and 2 pressures, 3 temperature, 4 and 5 temperatures of the pressure sensors.
inline constexpr std::uint8_t kPressureChannel = 1;
inline constexpr std::uint8_t kLastChannel = 15;

/// Answers `F48` and `F73`, requests `F48?` and `F73?`, and the refusals of both, `ERROR`.
inline constexpr FrameId kInitialised{"F48"}, kReading{"F73"}, kError{"ERROR"};
inline constexpr FrameId kInitialiseRequest{"F48?"}, kReadRequest{"F73?"};

struct Scanner {
  static constexpr std::size_t kMaxFrameLength = 10;

  /// Any address may begin a frame.
  static const std::uint8_t* find_start(const std::uint8_t* first, const std::uint8_t*) { return first; }
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

/// Answer to F73. It does not say which channel it is.
struct Reading {
  std::uint8_t address = 0;
  float value = 0;          ///< bar or C; infinite or no number when the measurement failed
  std::uint8_t status = 0;  ///< bit n: channel n has failed; 7: the transmitter has just begun
  bool operator==(const Reading&) const = default;
  [[nodiscard]] bool failed(std::uint8_t channel) const { return (status >> channel & 1U) != 0; }
};
[[nodiscard]] std::optional<Reading> decode_reading(Bytes frame);

/// Answer to F48: which transmitter it is.
struct Identity {
  std::uint8_t address = 0, device_class = 0, group = 0;
  std::uint8_t year = 0, week = 0;  ///< of its firmware
  std::uint8_t buffer = 0;          ///< longest frame that it takes
  std::uint8_t state = 0;           ///< 0: initialised for the first time since power came; 1: again
  bool operator==(const Identity&) const = default;
};
[[nodiscard]] std::optional<Identity> decode_identity(Bytes frame);

/// A function that was refused: 1 unknown function, 2 address or channel, 3 value, 32 not initialised.
struct Refusal {
  std::uint8_t address = 0, function = 0, error = 0;
  bool operator==(const Refusal&) const = default;
};
inline constexpr std::uint8_t kNotInitialised = 32;
[[nodiscard]] std::optional<Refusal> decode_refusal(Bytes frame);

/// The channel that a request F73? asks for.
[[nodiscard]] std::optional<std::uint8_t> requested_channel(Bytes frame);

[[nodiscard]] std::vector<std::uint8_t> encode(const Reading& reading);
[[nodiscard]] std::vector<std::uint8_t> encode(const Identity& identity);
[[nodiscard]] std::vector<std::uint8_t> encode(const Refusal& refusal);
[[nodiscard]] std::vector<std::uint8_t> initialise_request(std::uint8_t address);
[[nodiscard]] std::vector<std::uint8_t> read_request(std::uint8_t address, std::uint8_t channel);

}  // namespace navcal::protocols::keller

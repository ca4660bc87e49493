// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// Commands to a TCM2 (ICD section 1): case-sensitive, ended by CR; LF is ignored.
namespace navcal::protocols::tcm2 {

enum class Verb : std::uint8_t {
  go,                 ///< `go` words continuously
  halt,               ///< `h`
  sample,             ///< `s?` one word
  heading,            ///< `c?` one quantity
  inclination,        ///< `i?`
  magnetometer,       ///< `m?`
  temperature,        ///< `t?`
  calibration_score,  ///< `lc?`
  clear_calibration,  ///< `cc`
  warm_restart,       ///< `ax`
  set,                ///< `<parameter>=<value>`
};

enum class Parameter : std::uint8_t {
  output_heading,          ///< `ec=` e or d
  output_pitch,            ///< `ep=` e or d
  output_roll,             ///< `er=` e or d
  output_field,            ///< `em=` e or d
  output_temperature,      ///< `et=` e or d
  heading_unit,            ///< `uc=` d degrees, m mils
  tilt_unit,               ///< `ui=` d degrees, m mils
  temperature_unit,        ///< `ut=` c or f
  output_format,           ///< `sdo=` t standard, n NMEA, r raw
  baud,                    ///< `b=` index into kBauds; in force after a restart
  clock,                   ///< `clock=` 5 to 40 Hz
  sample_period,           ///< `sp=` divides the clock (TCM2), or output rate 1 to 8 Hz (TCM2.5)
  fast,                    ///< `fast=` e or d
  damping,                 ///< `damping=` e or d
  multipoint_calibration,  ///< `mpcal=` e or d
};

/// Baud rates by their index in `b=`.
inline constexpr int kBauds[] = {300, 600, 1200, 2400, 4800, 9600, 19200, 38400, 57600};

struct Command {
  Verb verb = Verb::go;
  Parameter parameter = Parameter::output_heading;  ///< of `set`
  char letter = '\0';                               ///< value of a parameter that takes letters
  int number = 0;                                   ///< value of a parameter that takes numbers

  bool operator==(const Command&) const = default;
};

[[nodiscard]] constexpr Command set(Parameter parameter, char letter) { return {Verb::set, parameter, letter, 0}; }
[[nodiscard]] constexpr Command set(Parameter parameter, int number) {
  return {Verb::set, parameter, '\0', number};
}

/// `uc`, `clock`, ...: as it stands in `:<parameter>=<value>`.
[[nodiscard]] std::string_view name_of(Parameter parameter);

/// The command as the host sends it, CR included.
[[nodiscard]] std::vector<std::uint8_t> encode_command(const Command& command);

/// Why the device refuses: error::kBadCommand or error::kBadParameter, to be sent as `:E0nn`.
struct Refusal {
  std::uint32_t error = 0;
  bool operator==(const Refusal&) const = default;
};

/// A line that a host sent, with or without its CR; LF is passed over.
[[nodiscard]] std::variant<Command, Refusal> parse_command(std::string_view line);

/// Cuts what a host sends into lines; id "COMMAND". Intact or not is for parse_command() to say.
struct CommandScanner {
  static constexpr std::size_t kMaxFrameLength = 64;  ///< the longest command has 10 bytes

  static const std::uint8_t* find_start(const std::uint8_t* first, const std::uint8_t* last);
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using CommandParser = StreamParser<CommandScanner>;

}  // namespace navcal::protocols::tcm2

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "protocols/nmea.h"
#include "protocols/nmea_decimal.h"

namespace navcal::protocols::nmea {

// Sentences of compasses, turn-rate sensors, transducers and echo sounders. Numbers are as the sentence says them,
// empty fields are nullopt. Each decoder answers nullopt when a field cannot be what it stands for.

/// HDT, HDM, HDG, THS. Degrees.
struct Heading {
  std::optional<Decimal> heading_deg;    ///< 0 to 360
  bool is_true = false;                  ///< from true north (HDT, THS), else magnetic
  std::optional<Decimal> deviation_deg;  ///< HDG, east positive
  std::optional<Decimal> variation_deg;  ///< HDG, east positive
  std::optional<char> mode;              ///< THS: A autonomous, E estimated, M manual, S simulated, V not valid
};
[[nodiscard]] std::optional<Heading> decode_heading(const Sentence& sentence, Type type);

/// ROT. Positive to starboard.
struct Rot {
  std::optional<Decimal> rate_deg_min;
  bool valid = false;
};
[[nodiscard]] std::optional<Rot> decode_rot(const Sentence& sentence);

/// XDR: named transducers. Views lie in the frame.
struct Xdr {
  struct Transducer {
    char type = 0;  ///< A angle, C temperature, G generic, P pressure, ...; 0: empty
    std::optional<Decimal> value;
    char unit = 0;  ///< D degrees, C Celsius, B bar, ...; 0: empty
    std::string_view name;
  };
  static constexpr std::size_t kMaxTransducers = 32;
  std::array<Transducer, kMaxTransducers> transducers{};
  std::size_t count = 0;
};
[[nodiscard]] std::optional<Xdr> decode_xdr(const Sentence& sentence);

/// Attitude as motion sensors and receivers with several antennas send it, each maker in sentences of his own.
struct Attitude {
  std::optional<Decimal> heading_deg;          ///< from true north, 0 to 360
  std::optional<Decimal> pitch_deg, roll_deg;  ///< nose-up, starboard-down
};
/// No member has a value where a sentence PSAT, PFEC or PASHR is about something else, and where the device
/// declares its attitude not valid.
[[nodiscard]] std::optional<Attitude> decode_attitude(const Sentence& sentence);

/// PTNTHTM and PTNTHPR, True North Technologies and Honeywell: heading, tilt, and with PTNTHTM dip and horizontal
/// field of a compass. Unit and
/// reference of the angles are a set-up of the device (degrees, or counts of 16 bits), so nothing is held to a
/// range.
struct Ptnthtm {
  std::optional<Decimal> heading, pitch, roll, dip, horizontal_field;
  char magnetic_status = 0, pitch_status = 0,
       roll_status = 0;  ///< N normal; C, L low, M, H high, O, P, V; 0: empty
};
[[nodiscard]] std::optional<Ptnthtm> decode_ptnthtm(const Sentence& sentence);

/// DBT and DPT: depth of the water below the transducer, in metres.
struct Depth {
  std::optional<double> depth_m;    ///< DBT: of the metres if given, else of feet, else of fathoms
  std::optional<Decimal> offset_m;  ///< DPT: positive from transducer to water line, negative to keel
  std::optional<Decimal> range_m;   ///< DPT: of the scale in use
};
[[nodiscard]] std::optional<Depth> decode_depth(const Sentence& sentence, Type type);

}  // namespace navcal::protocols::nmea

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "protocols/gps_fix.h"
#include "protocols/nmea.h"
#include "protocols/nmea_decimal.h"
#include "protocols/units.h"
#include "protocols/utc.h"

namespace navcal::protocols::nmea {

// Sentences of position receivers (IEC 61162-1). Numbers are as the sentence says them, empty fields are nullopt.
// Each decoder answers nullopt when a field cannot be what it stands for (letters in a number, hour 25, latitude
// 91): such a sentence is intact and out of range.

struct LatLon {
  double latitude_deg = 0;   ///< north positive
  double longitude_deg = 0;  ///< east positive
};

/// Position and its quality: GGA, or GNS of a receiver of several systems, whose best mode counts.
struct Gga {
  std::optional<TimeOfDay> time;
  std::optional<LatLon> place;
  std::uint8_t quality = 0;  ///< 0 none, 1 GPS, 2 differential, 4/5 RTK, 6 estimated, 7 manual, 8 simulated
  std::optional<std::uint8_t> satellites;  ///< in use
  std::optional<Decimal> hdop;
  std::optional<Decimal> altitude_m;          ///< above mean sea level
  std::optional<Decimal> geoid_separation_m;  ///< of mean sea level above the ellipsoid
  std::optional<Decimal> correction_age_s;
  std::optional<std::uint16_t> station;

  /// 3d only when height and four satellites say so.
  [[nodiscard]] Fix fix() const;
};

/// The recommended minimum: time, date, place, motion.
struct Rmc {
  std::optional<TimeOfDay> time;
  std::optional<Date> date;
  bool valid = false;
  std::optional<LatLon> place;
  std::optional<Decimal> speed_kn;
  std::optional<Decimal> course_deg;     ///< over ground, from true north
  std::optional<Decimal> variation_deg;  ///< magnetic, east positive
  std::optional<char> mode;              ///< A autonomous, D differential, E estimated, N not valid, ...

  /// 2d at most: the sentence knows nothing of height.
  [[nodiscard]] Fix fix() const;
};

/// Course and speed over ground.
struct Vtg {
  std::optional<Decimal> course_true_deg, course_magnetic_deg;
  std::optional<Decimal> speed_kn, speed_km_h;
  std::optional<char> mode;
};

struct Gll {
  std::optional<LatLon> place;
  std::optional<TimeOfDay> time;
  bool valid = false;
  std::optional<char> mode;

  [[nodiscard]] Fix fix() const;
};

/// Satellites in use and dilutions of precision.
struct Gsa {
  static constexpr std::size_t kSlots = 12;
  std::optional<char> selection;  ///< A automatic, M manual 2D/3D
  Fix fix = Fix::none;
  std::array<std::uint16_t, kSlots> satellites{};
  std::size_t count = 0;
  std::optional<Decimal> pdop, hdop, vdop;
};

/// Satellites in view, up to four a sentence.
struct Gsv {
  struct Satellite {
    std::uint16_t number = 0;
    std::optional<std::uint8_t> elevation_deg;
    std::optional<std::uint16_t> azimuth_deg;
    std::optional<std::uint8_t> cn0_dBHz;  ///< empty: not tracked
  };
  std::uint8_t sentences = 0;  ///< of the whole report
  std::uint8_t sentence = 0;   ///< this one, from 1
  std::uint8_t visible = 0;
  std::array<Satellite, 4> satellites{};
  std::size_t count = 0;
};

/// Time and date.
struct Zda {
  std::optional<TimeOfDay> time;
  std::optional<Date> date;
  std::optional<std::int16_t> zone_min;  ///< local zone, to be added to local time to get UTC
};

[[nodiscard]] std::optional<Gga> decode_gga(const Sentence& sentence);
[[nodiscard]] std::optional<Gga> decode_gns(const Sentence& sentence);
[[nodiscard]] std::optional<Rmc> decode_rmc(const Sentence& sentence);
[[nodiscard]] std::optional<Vtg> decode_vtg(const Sentence& sentence);
[[nodiscard]] std::optional<Gll> decode_gll(const Sentence& sentence);
[[nodiscard]] std::optional<Gsa> decode_gsa(const Sentence& sentence);
[[nodiscard]] std::optional<Gsv> decode_gsv(const Sentence& sentence);
[[nodiscard]] std::optional<Zda> decode_zda(const Sentence& sentence);

}  // namespace navcal::protocols::nmea

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocols/gps_fix.h"
#include "protocols/utc.h"

namespace navcal::protocols::nmea {

// Sentences about a vehicle, for chart plotters and other readers of NMEA 0183 (IEC 61162-1). Each function
// appends whole sentences with checksum and CR LF. A value that is absent is an empty field. Angles are degrees.

/// A position and how good it is.
struct StatedPosition {
  std::string_view talker = "GP";  ///< GP, GN, IN, ...
  /// UTC of the instant that the position is about.
  std::optional<Date> date;
  std::optional<TimeOfDay> time;
  Fix fix = Fix::none;                                ///< propagated: estimated, dead reckoning
  std::optional<double> latitude_deg, longitude_deg;  ///< WGS84
  std::optional<double> altitude_m;                   ///< above mean sea level
  std::optional<double> geoid_separation_m;           ///< of mean sea level above the ellipsoid
  std::optional<double> speed_m_s, course_deg;        ///< over ground, from true north
  std::optional<double> variation_deg;                ///< magnetic, east positive
  std::optional<double> pdop, hdop, vdop;
  unsigned satellites = 0;  ///< in use
  std::optional<double> north_std_m, east_std_m, height_std_m;

  [[nodiscard]] bool is_known() const;
};

/// Status A with a position; the mode tells a fix (A) from dead reckoning (E) and a held position (M). Status V
/// and mode N without.
void append_rmc(std::string& out, const StatedPosition& position);
/// Quality 1: fix, 6: dead reckoning, 7: held, 0: none.
void append_gga(std::string& out, const StatedPosition& position);
/// `used`: numbers of satellites, of which twelve are sent.
void append_gsa(std::string& out, const StatedPosition& position, std::span<const std::uint16_t> used);
/// Standard errors; nothing when none is known.
void append_gst(std::string& out, const StatedPosition& position);

struct StatedSatellite {
  std::uint16_t number = 0;
  std::optional<double> elevation_deg, azimuth_deg, cn0_dBHz;
};
/// All satellites in view, four a sentence.
void append_gsv(std::string& out, std::string_view talker, std::span<const StatedSatellite> satellites);

/// HEHDT: heading from true north.
void append_hdt(std::string& out, double heading_deg);
/// HCHDG: `sensor_deg` as the magnetic compass shows it; with deviation, and then variation, added it is the true
/// heading. East is positive.
void append_hdg(std::string& out, double sensor_deg, std::optional<double> deviation_deg,
                std::optional<double> variation_deg);
/// TIROT: rate of turn, degrees per minute, positive to starboard.
void append_rot(std::string& out, double rate_deg_min);
/// SDDPT: depth of the water below the transducer; `offset_m` is from the transducer up to the water line.
void append_dpt(std::string& out, double depth_m, std::optional<double> offset_m);
/// SDDBT: distance from the transducer to the floor; nullopt: there was no echo.
void append_dbt(std::string& out, std::optional<double> distance_m);
/// VWVHW: speed through the water ahead, with the headings that are known.
void append_vhw(std::string& out, std::optional<double> true_deg, std::optional<double> magnetic_deg,
                double speed_m_s);

struct StatedTransducer {
  char type = 'A';  ///< A angle, D displacement, ...
  double value = 0;
  int decimals = 2;
  char unit = 'D';  ///< D degrees, M metres, ...
  std::string_view name;
};
/// IIXDR; nothing without transducers.
void append_xdr(std::string& out, std::span<const StatedTransducer> transducers);

}  // namespace navcal::protocols::nmea

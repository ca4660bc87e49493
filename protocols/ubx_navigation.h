// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/gps_fix.h"
#include "protocols/ubx.h"
#include "protocols/utc.h"

/// Messages of class NAV (u-blox interface description F9, section "UBX-NAV"; layout in ICD section 6). Decoders
/// take an intact frame and give nullopt for another message or a payload that is too short.
namespace navcal::protocols::ubx {

/// NAV-PVT: position, velocity and time of one epoch. Standard errors are one sigma, as the receiver estimates
/// them.
struct NavPvt {
  std::uint32_t time_of_week_ms = 0;  ///< GPS time of week of the epoch
  Date date;                          ///< UTC
  std::uint8_t hour = 0, minute = 0, second = 0;
  /// Correction of the whole second above, -1e9 to 1e9: the receiver rounds the time to a hundredth first.
  std::int32_t nanosecond = 0;
  bool date_valid = false, time_valid = false;
  bool fully_resolved = false;  ///< no whole second of UTC is uncertain
  double time_accuracy_s = 0;
  std::uint8_t fix_type = 0;  ///< 0 none, 1 dead reckoning, 2 2D, 3 3D, 4 GNSS and dead reckoning, 5 time only
  bool fix_ok = false;        ///< within the limits of accuracy and DOP that were configured
  bool differential = false;
  std::uint8_t carrier_solution = 0;  ///< 0 none, 1 float, 2 fixed
  std::uint8_t satellites = 0;
  double latitude_deg = 0, longitude_deg = 0;  ///< WGS84
  double height_m = 0, height_msl_m = 0;       ///< above the ellipsoid, above mean sea level
  double horizontal_accuracy_m = 0, vertical_accuracy_m = 0;
  std::array<double, 3> velocity_ned_m_s{};
  double ground_speed_m_s = 0;
  double heading_of_motion_deg = 0;  ///< clockwise from true north
  double speed_accuracy_m_s = 0, heading_accuracy_deg = 0;
  double pdop = 0;
  bool position_invalid = false;  ///< invalidLlh: position and height are not to be used

  /// UTC in nanoseconds since 1970; nullopt unless date and time are valid and exist in the calendar, 1980 to
  /// 2261.
  [[nodiscard]] std::optional<std::int64_t> utc_ns() const;
  /// The kind of fix; `none` unless `fix_ok`, and for a time alone.
  [[nodiscard]] Fix fix() const;
  bool operator==(const NavPvt&) const = default;
};
[[nodiscard]] std::optional<NavPvt> decode_nav_pvt(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_nav_pvt(const NavPvt& pvt);

/// HNR-PVT, carried on between the epochs by inertial sensors. It has no accuracy of time, satellites, DOP and
/// components of the velocity.
[[nodiscard]] std::optional<NavPvt> decode_hnr_pvt(Bytes frame);

/// NAV-ATT and HNR-ATT: roll, pitch and true heading of the vehicle. An accuracy of 0 says that there is no angle.
struct NavAttitude {
  std::array<double, 3> angles_deg{}, accuracies_deg{};
};
[[nodiscard]] std::optional<NavAttitude> decode_attitude(Bytes frame);

/// NAV-RELPOSNED: from the antenna of the reference to the receiver's own.
struct RelativePosition {
  std::array<double, 3> position_ned_m{}, accuracies_m{};
  bool position_valid = false;
  NavAttitude line;  ///< its heading alone, from version 1 on (F9)
};
[[nodiscard]] std::optional<RelativePosition> decode_nav_relposned(Bytes frame);

/// NAV-TIMEGPS.
struct NavTimeGps {
  std::uint32_t time_of_week_ms = 0;
  std::int32_t fraction_ns = 0;  ///< added to the time of week, -500000 to 500000
  std::int16_t week = 0;
  std::int8_t leap_s = 0;  ///< GPS time minus UTC
  bool time_of_week_valid = false, week_valid = false, leap_valid = false;
  double time_accuracy_s = 0;
  bool operator==(const NavTimeGps&) const = default;
};
[[nodiscard]] std::optional<NavTimeGps> decode_nav_timegps(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_nav_timegps(const NavTimeGps& time);

/// NAV-DOP; 99.99 is what receivers send for none.
struct NavDop {
  std::uint32_t time_of_week_ms = 0;
  double geometric = 0, position = 0, time = 0, vertical = 0, horizontal = 0, northing = 0, easting = 0;
  bool operator==(const NavDop&) const = default;
};
[[nodiscard]] std::optional<NavDop> decode_nav_dop(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_nav_dop(const NavDop& dop);

/// NAV-SAT: satellites that are tracked or known.
struct NavSat {
  struct Satellite {
    std::uint8_t gnss = 0;    ///< 0 GPS, 1 SBAS, 2 Galileo, 3 BeiDou, 5 QZSS, 6 GLONASS
    std::uint8_t number = 0;  ///< within its system
    std::uint8_t cn0_dBHz = 0;
    std::int8_t elevation_deg = 0;  ///< beyond +- 90: unknown
    std::int16_t azimuth_deg = 0;
    double residual_m = 0;     ///< of the pseudorange
    std::uint8_t quality = 0;  ///< 0 no signal to 7 carrier and code locked
    bool used = false;         ///< in the solution
    std::uint8_t health = 0;   ///< 0 unknown, 1 healthy, 2 unhealthy
    std::uint32_t flags = 0;   ///< as sent; the three members above are its lowest six bits
    bool operator==(const Satellite&) const = default;
  };
  static constexpr std::size_t kSlots = 255;

  std::uint32_t time_of_week_ms = 0;
  std::size_t count = 0;  ///< slots in use
  std::array<Satellite, kSlots> satellites{};
};
[[nodiscard]] std::optional<NavSat> decode_nav_sat(Bytes frame);
/// `quality`, `used` and `health` replace the lowest six bits of `flags`.
[[nodiscard]] std::vector<std::uint8_t> encode_nav_sat(const NavSat& satellites);

}  // namespace navcal::protocols::ubx

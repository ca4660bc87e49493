// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "instruments/samples.h"
#include "pipeline/earth_field.h"
#include "pipeline/navigation.h"

namespace navcal::daemon {

// Measurements in gpsd's words (gpsd_json(5) of release 3.22; docs/status-protocol.md): degrees, metres, seconds,
// and beyond gpsd microtesla and m/s2. Each appends one line, newline included.

/// Attributes common to all reports. `utc_known` false omits times, because they would be wrong.
struct ReportSource {
  std::string_view device;
  bool utc_known = true;
  instruments::CalibrationName calibration{};  ///< in force when the sample was made
  bool is_autopilot = false;                   ///< its own headings are estimates
};

/// TPV: time is the second that the message states. Position and its standard errors only when the receiver calls
/// it a fix.
void append_tpv(std::string& out, const instruments::GpsSample& gps, const instruments::Stamp& stamp,
                ReportSource source);

/// TPV of a position that was reckoned on from the last fix: 2D, status 5 (dead reckoning), with its standard
/// errors.
void append_tpv(std::string& out, const pipeline::NavigationSample& sample, bool utc_known);

/// SKY: satellites, and the dilution of precision of the same receiver's last position, if any.
void append_sky(std::string& out, const instruments::SkySample& sky, const instruments::GpsSample* position,
                const instruments::Stamp& stamp, ReportSource source);

/// ATT of a compass. The declination makes true north of the magnetic heading, which is that of the calibration in
/// force where there is one; the device's own then stands beside it. Without, and where the declination is not
/// known, the heading is passed on as the device said it, even beyond 360: a mis-set unit stays visible. "north"
/// says whether the heading is from true or from magnetic north.
void append_att(std::string& out, const instruments::CompassSample& compass, const pipeline::EarthField& field,
                const instruments::Stamp& stamp, ReportSource source);

/// ATT of the inertial card: rates in deg/s, specific force in m/s2, depth in m.
void append_att(std::string& out, const instruments::ImuSample& imu, const instruments::Stamp& stamp,
                ReportSource source);

/// Magnetic inclination, radians, positive down, from the field and the tilt (thesis eq. 2.2); the device's own
/// value when it has one; nullopt when neither is known.
[[nodiscard]] std::optional<double> dip_of(const instruments::CompassSample& compass);

}  // namespace navcal::daemon

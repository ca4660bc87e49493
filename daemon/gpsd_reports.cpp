// SPDX-License-Identifier: Apache-2.0
#include "daemon/gpsd_reports.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

#include "base/angles.h"
#include "base/durations.h"
#include "daemon/json_text.h"
#include "record/json/message_json.h"

namespace navcal::daemon {
namespace {

using instruments::Fix;

constexpr std::string_view kEnd = "}\r\n";

void begin(std::string& out, std::string_view report, std::string_view device) {
  out += "{\"class\":\"";
  out += report;
  out += "\",\"device\":";
  append_quoted(out, device);
}

void key(std::string& out, std::string_view name) {
  out += ",\"";
  out += name;
  out += "\":";
}

void fixed(std::string& out, std::string_view name, const std::optional<double>& value, int decimals,
           double unit = 1) {
  if (!value || !std::isfinite(*value)) return;
  key(out, name);
  append_fixed(out, *value * unit, decimals);
}

void shortest(std::string& out, std::string_view name, double value, int decimals) {
  if (!std::isfinite(value)) return;
  key(out, name);
  append_shortest(out, value, decimals);
}

void time(std::string& out, std::int64_t utc_ns, int decimals) {
  key(out, "time");
  append_utc(out, utc_ns, decimals);
}

/// Standard error of the time of validity.
void time_std(std::string& out, std::string_view name, const instruments::Stamp& stamp) {
  if (stamp.std_ns <= 0) return;
  key(out, name);
  append_shortest(out, static_cast<double>(stamp.std_ns) * 1e-9, 9);
}

struct GpsdFix {
  int mode;    ///< 1 no fix, 2 2D, 3 3D
  int status;  ///< 0: nothing to add; 5 dead reckoning, 7 surveyed position
};

constexpr GpsdFix kReckoned{2, 5};
constexpr double kStandstill_m_s = 0.01;

constexpr GpsdFix gpsd_fix(Fix fix) {
  switch (fix) {
    case Fix::fix_2d: return {2, 0};
    case Fix::fix_3d: return {3, 0};
    case Fix::propagated: return {2, 5};
    case Fix::hold: return {3, 7};
    case Fix::none:
    case Fix::acquiring:
    case Fix::bad_geometry: break;
  }
  return {1, 0};
}

double length(const instruments::Vector3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// gpsd's error estimates of a receiver's position, one standard deviation each, where the device or the
/// configuration states them.
void position_errors(std::string& out, const instruments::GpsSample& gps) {
  fixed(out, "epx", gps.position_std_m, 3);
  fixed(out, "epy", gps.position_std_m, 3);
  if (gps.position_std_m) fixed(out, "eph", *gps.position_std_m * std::numbers::sqrt2, 3);
  fixed(out, "epv", gps.height_std_m, 3);
  if (!gps.speed_m_s || !gps.velocity_std_m_s) return;
  fixed(out, "eps", gps.velocity_std_m_s, 3);
  if (*gps.speed_m_s > kStandstill_m_s)
    fixed(out, "epd", std::atan2(*gps.velocity_std_m_s, *gps.speed_m_s), 3, base::kDegreesPerRadian);
}

/// Degrees from true north.
double true_heading_deg(double heading_rad, double declination_rad) {
  const double heading_deg = heading_rad * base::kDegreesPerRadian;
  if (declination_rad == 0) return heading_deg;
  const double wrapped = std::fmod(heading_deg + declination_rad * base::kDegreesPerRadian, 360.0);
  return wrapped < 0 ? wrapped + 360.0 : wrapped;
}

void calibration(std::string& out, ReportSource source) {
  if (source.calibration.number == 0) return;
  key(out, "calibration");
  append_quoted(out, record::calibration_text(source.calibration));
}

}  // namespace

void append_tpv(std::string& out, const instruments::GpsSample& gps, const instruments::Stamp& stamp,
                ReportSource source) {
  const GpsdFix fix = gpsd_fix(gps.fix);
  begin(out, "TPV", source.device);
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"mode\":{}"), fix.mode);
  if (fix.status != 0) fmt::format_to(std::back_inserter(out), FMT_STRING(",\"status\":{}"), fix.status);
  if (gps.time_utc_ns) {
    time(out, *gps.time_utc_ns, *gps.time_utc_ns % base::kMillisecond_ns == 0 ? 3 : 9);
  } else if (source.utc_known) {
    time(out, stamp.validity_utc_ns, 3);
    time_std(out, "ept", stamp);
  }
  if (fix.mode >= 2) {
    fixed(out, "lat", gps.latitude_rad, 9, base::kDegreesPerRadian);
    fixed(out, "lon", gps.longitude_rad, 9, base::kDegreesPerRadian);
    fixed(out, "altHAE", gps.height_m, 4);
    fixed(out, "altMSL", gps.height_msl_m, 4);
    fixed(out, "alt", gps.height_msl_m, 4);
    fixed(out, "track", gps.course_rad, 4, base::kDegreesPerRadian);
    fixed(out, "speed", gps.speed_m_s, 3);
    fixed(out, "climb", gps.climb_m_s, 3);
    position_errors(out, gps);
  }
  if (gps.time_corrected) out += ",\"time_corrected\":true";
  if (!gps.leap_known) out += ",\"leap_known\":false";
  out += kEnd;
}

void append_tpv(std::string& out, const pipeline::NavigationSample& sample, bool utc_known) {
  const auto& estimate = sample.estimate;
  begin(out, "TPV", pipeline::kNavigationDevice);
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"mode\":{},\"status\":{}"), kReckoned.mode,
                 kReckoned.status);
  if (utc_known) {
    time(out, sample.stamp.validity_utc_ns, 3);
    time_std(out, "ept", sample.stamp);
  }
  fixed(out, "lat", sample.latitude_rad, 9, base::kDegreesPerRadian);
  fixed(out, "lon", sample.longitude_rad, 9, base::kDegreesPerRadian);
  const auto& std_m = estimate.position_std_m;
  fixed(out, "epx", std_m.y(), 3);
  fixed(out, "epy", std_m.x(), 3);
  fixed(out, "eph", std_m.norm(), 3);
  if (const auto& velocity = estimate.velocity_m_s) {
    const double speed_m_s = std::hypot(velocity->x(), velocity->y());
    // The track is undefined while the vehicle stands still.
    if (speed_m_s > kStandstill_m_s) {
      const double track_rad = std::atan2(velocity->y(), velocity->x());
      fixed(out, "track", track_rad < 0 ? track_rad + 2 * std::numbers::pi : track_rad, 4,
            base::kDegreesPerRadian);
    }
    fixed(out, "speed", speed_m_s, 3);
    fixed(out, "climb", -velocity->z(), 3);
  }
  fixed(out, "depth", estimate.depth_m, 3);
  out += kEnd;
}

void append_sky(std::string& out, const instruments::SkySample& sky, const instruments::GpsSample* position,
                const instruments::Stamp& stamp, ReportSource source) {
  begin(out, "SKY", source.device);
  if (source.utc_known) time(out, stamp.validity_utc_ns, 3);
  if (position != nullptr) fixed(out, position->fix == Fix::fix_2d ? "hdop" : "pdop", position->dop, 2);
  std::size_t used = 0;
  for (std::size_t i = 0; i < sky.count; ++i) used += sky.satellites[i].used ? 1 : 0;
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"nSat\":{},\"uSat\":{},\"satellites\":["), sky.count,
                 used);
  for (std::size_t i = 0; i < sky.count; ++i) {
    const auto& satellite = sky.satellites[i];
    if (i > 0) out += ',';
    fmt::format_to(std::back_inserter(out), FMT_STRING("{{\"PRN\":{}"), satellite.prn);
    fixed(out, "el", satellite.elevation_deg, 1);
    fixed(out, "az", satellite.azimuth_deg, 1);
    fixed(out, "ss", satellite.cn0_dBHz, 1);
    out += satellite.used ? ",\"used\":true}" : ",\"used\":false}";
  }
  out += ']';
  out += kEnd;
}

std::optional<double> dip_of(const instruments::CompassSample& compass) {
  if (compass.dip_rad) return compass.dip_rad;
  if (!compass.field_body_uT || !compass.pitch_rad || !compass.roll_rad) return std::nullopt;
  const auto& [x, y, z] = *compass.field_body_uT;
  const double sin_pitch = std::sin(*compass.pitch_rad), cos_pitch = std::cos(*compass.pitch_rad);
  const double sin_roll = std::sin(*compass.roll_rad), cos_roll = std::cos(*compass.roll_rad);
  const double across = y * sin_roll + z * cos_roll;
  const double forward = x * cos_pitch + across * sin_pitch;
  const double starboard = y * cos_roll - z * sin_roll;
  const double down = across * cos_pitch - x * sin_pitch;
  return std::atan2(down, std::hypot(forward, starboard));
}

void append_att(std::string& out, const instruments::CompassSample& compass, const pipeline::EarthField& field,
                const instruments::Stamp& stamp, ReportSource source) {
  begin(out, "ATT", source.device);
  if (source.utc_known) {
    time(out, stamp.validity_utc_ns, 6);
    time_std(out, "time_std", stamp);
  }
  const auto& heading_rad = compass.heading_calibrated_rad ? compass.heading_calibrated_rad : compass.heading_rad;
  if (heading_rad && std::isfinite(*heading_rad)) {
    const double heading_deg = true_heading_deg(*heading_rad, compass.heading_is_true ? 0 : field.declination_rad);
    const bool is_true = compass.heading_is_true || field.declination_source != pipeline::EarthField::Source::none;
    fixed(out, "heading", heading_deg, 4);
    fixed(out, "yaw", heading_deg, 4);
    out += is_true ? R"(,"north":"true")" : R"(,"north":"magnetic")";
    if (source.is_autopilot)
      out += compass.heading_is_true ? R"(,"heading_source":"autopilot")" : R"(,"heading_source":"calibration")";
  }
  if (compass.heading_calibrated_rad)
    fixed(out, "heading_device", compass.heading_rad, 4, base::kDegreesPerRadian);
  fixed(out, "pitch", compass.pitch_rad, 4, base::kDegreesPerRadian);
  fixed(out, "roll", compass.roll_rad, 4, base::kDegreesPerRadian);
  if (heading_rad) fixed(out, "heading_std", compass.heading_std_rad, 4, base::kDegreesPerRadian);
  if (compass.pitch_rad) fixed(out, "pitch_std", compass.tilt_std_rad, 4, base::kDegreesPerRadian);
  if (compass.roll_rad) fixed(out, "roll_std", compass.tilt_std_rad, 4, base::kDegreesPerRadian);
  fixed(out, "dip", dip_of(compass), 3, base::kDegreesPerRadian);
  if (compass.field_body_uT) {
    const auto& measured = *compass.field_body_uT;
    shortest(out, "mag_len", length(measured), 4);
    // The shortest text within six decimals keeps the digits of a device that reports two.
    shortest(out, "mag_x", measured[0], 6);
    shortest(out, "mag_y", measured[1], 6);
    shortest(out, "mag_z", measured[2], 6);
  }
  fixed(out, "gyro_z", compass.turn_rate_rad_s, 4, base::kDegreesPerRadian);
  if (compass.temperature_C) shortest(out, "temp", *compass.temperature_C, 4);
  if (compass.error) fmt::format_to(std::back_inserter(out), FMT_STRING(",\"error\":\"{:03X}\""), *compass.error);
  calibration(out, source);
  out += kEnd;
}

void append_att(std::string& out, const instruments::ImuSample& imu, const instruments::Stamp& stamp,
                ReportSource source) {
  begin(out, "ATT", source.device);
  if (source.utc_known) {
    time(out, stamp.validity_utc_ns, 6);
    time_std(out, "time_std", stamp);
  }
  if (const auto& force = imu.specific_force_m_s2) {
    fixed(out, "acc_len", length(*force), 4);
    fixed(out, "acc_x", (*force)[0], 4);
    fixed(out, "acc_y", (*force)[1], 4);
    fixed(out, "acc_z", (*force)[2], 4);
  }
  if (const auto& rate = imu.rate_rad_s) {
    fixed(out, "gyro_x", (*rate)[0], 4, base::kDegreesPerRadian);
    fixed(out, "gyro_y", (*rate)[1], 4, base::kDegreesPerRadian);
    fixed(out, "gyro_z", (*rate)[2], 4, base::kDegreesPerRadian);
  }
  fixed(out, "gyro_b_z", imu.yaw_rate_b_rad_s, 4, base::kDegreesPerRadian);
  fixed(out, "gyro_z_calibrated", imu.yaw_rate_calibrated_rad_s, 4, base::kDegreesPerRadian);
  fixed(out, "gyro_b_z_calibrated", imu.yaw_rate_b_calibrated_rad_s, 4, base::kDegreesPerRadian);
  fixed(out, "depth", imu.depth_m, 4);
  if (imu.rate_rad_s) fixed(out, "gyro_std", imu.rate_std_rad_s, 4, base::kDegreesPerRadian);
  if (imu.specific_force_m_s2) fixed(out, "acc_std", imu.specific_force_std_m_s2, 4);
  if (imu.depth_m) fixed(out, "depth_std", imu.depth_std_m, 4);
  calibration(out, source);
  out += kEnd;
}

}  // namespace navcal::daemon

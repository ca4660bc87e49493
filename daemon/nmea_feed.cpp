// SPDX-License-Identifier: Apache-2.0
#include "daemon/nmea_feed.h"

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "daemon/publisher.h"

namespace navcal::daemon {
namespace nmea = protocols::nmea;
namespace {

constexpr double kSlowest_m_s = 0.01;  ///< below it a track has no direction
/// Nearer to the vertical, a rate of turn has no meaning.
constexpr double kSteepest_rad = 80 * base::kRadiansPerDegree;
constexpr double kSecondsPerMinute = 60;

std::optional<double> in_degrees(const std::optional<double>& angle_rad) {
  if (!angle_rad) return std::nullopt;
  return *angle_rad * base::kDegreesPerRadian;
}

void put_time(nmea::StatedPosition& position, std::int64_t utc_ns) {
  position.date = protocols::date_of(utc_ns);
  position.time = protocols::time_of_day(utc_ns);
}

void append_position(std::string& out, const nmea::StatedPosition& position,
                     std::span<const std::uint16_t> used = {}) {
  nmea::append_rmc(out, position);
  nmea::append_gga(out, position);
  nmea::append_gsa(out, position, used);
  nmea::append_gst(out, position);
}

/// Talker of the constellation that a satellite's number belongs to (docs/status-protocol.md, SKY).
std::string_view talker_of(std::uint16_t number) {
  if (number > 400) return "GB";
  if (number > 300) return "GA";
  if (number > 192 && number <= 202) return "GQ";
  return number > 64 && number <= 96 ? "GL" : "GP";
}

std::optional<double> turn_rate_deg_min(const VehicleState& state) {
  if (!state.rate_rad_s) return std::nullopt;
  const double roll_rad = state.roll_rad.value_or(0), pitch_rad = state.pitch_rad.value_or(0);
  if (std::abs(pitch_rad) > kSteepest_rad) return std::nullopt;
  const double rate_rad_s =
      ((*state.rate_rad_s)[1] * std::sin(roll_rad) + (*state.rate_rad_s)[2] * std::cos(roll_rad)) /
      std::cos(pitch_rad);
  return rate_rad_s * base::kDegreesPerRadian * kSecondsPerMinute;
}

using Transducers = std::vector<nmea::StatedTransducer>;

void add_angle(Transducers& all, const std::optional<double>& angle_rad, std::string_view name) {
  if (angle_rad && std::isfinite(*angle_rad))
    all.push_back({'A', *angle_rad * base::kDegreesPerRadian, 2, 'D', name});
}

void add_depth(Transducers& all, const std::optional<double>& depth_m, std::string_view name) {
  if (depth_m && std::isfinite(*depth_m)) all.push_back({'D', *depth_m, 3, 'M', name});
}

/// XDR with the attitude, and another with depth and its standard error.
void append_transducers(std::string& out, const VehicleState& state) {
  Transducers attitude, depth;
  add_angle(attitude, state.pitch_rad, "PITCH");
  add_angle(attitude, state.roll_rad, "ROLL");
  nmea::append_xdr(out, attitude);
  add_depth(depth, state.depth_m, "DEPTH");
  if (state.depth_m) add_depth(depth, state.depth_std_m, "STD_DEP");
  nmea::append_xdr(out, depth);
}

struct StandardErrors {
  std::optional<double> heading_rad, pitch_rad, roll_rad;
};

/// XDR with standard errors of the attitude. Their names must not contain PITCH or ROLL, because OpenCPN takes any
/// such angle for the attitude.
void append_errors(std::string& out, const StandardErrors& errors) {
  Transducers all;
  add_angle(all, errors.heading_rad, "STD_HDG");
  add_angle(all, errors.pitch_rad, "STD_PIT");
  add_angle(all, errors.roll_rad, "STD_ROL");
  nmea::append_xdr(out, all);
}

}  // namespace

NmeaFeed::NmeaFeed(const config::Settings& settings, const pipeline::Pipeline& pipeline, StatusServer& server)
    : settings_(settings), pipeline_(pipeline), server_(server), used_(settings.ports.size()) {}

bool NmeaFeed::serves(std::uint16_t port) const {
  return pipeline_.sources()[config::Role::position].value_or(port) == port;
}

std::optional<double> NmeaFeed::variation_deg() const {
  const auto& field = pipeline_.earth_field();
  if (field.declination_source == pipeline::EarthField::Source::none) return std::nullopt;
  return field.declination_rad * base::kDegreesPerRadian;
}

void NmeaFeed::sample(const instruments::Sample& sample) {
  if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value)) {
    position(sample, *gps);
  } else if (const auto* sky = std::get_if<instruments::SkySample>(&sample.value)) {
    satellites(sample.port, *sky);
  }
}

void NmeaFeed::position(const instruments::Sample& sample, const instruments::GpsSample& gps) {
  nmea::StatedPosition position;
  position.fix = gps.fix;
  position.latitude_deg = in_degrees(gps.latitude_rad);
  position.longitude_deg = in_degrees(gps.longitude_rad);
  // Nobody who follows the vehicle is to lose the estimate because a receiver says that it has no fix.
  const NmeaKey key{ReportClass::tpv, sample.port, serves(sample.port) && (position.is_known() || !is_reckoned_)};
  if (!server_.watched(key)) return;
  if (gps.time_utc_ns) {
    put_time(position, *gps.time_utc_ns);
  } else if (pipeline_.mapping().source != pipeline::UtcMapping::Source::none) {
    put_time(position, sample.stamp.validity_utc_ns);
  }
  position.altitude_m = gps.height_msl_m;
  if (gps.height_m && gps.height_msl_m) position.geoid_separation_m = *gps.height_m - *gps.height_msl_m;
  position.speed_m_s = gps.speed_m_s;
  position.course_deg = in_degrees(gps.course_rad);
  position.variation_deg = variation_deg();
  (gps.fix == instruments::Fix::fix_2d ? position.hdop : position.pdop) = gps.dop;
  const auto& used = used_[sample.port];
  position.satellites = used.empty() ? gps.tracked.value_or(0) : static_cast<unsigned>(used.size());
  position.north_std_m = position.east_std_m = gps.position_std_m;
  position.height_std_m = gps.height_std_m;
  sentences_.clear();
  append_position(sentences_, position, used);
  server_.publish(key, sentences_);
}

void NmeaFeed::satellites(std::uint16_t port, const instruments::SkySample& sky) {
  auto& used = used_[port];
  used.clear();
  for (std::size_t i = 0; i < sky.count; ++i) {
    if (sky.satellites[i].used) used.push_back(sky.satellites[i].prn);
  }
  const NmeaKey key{ReportClass::sky, port, serves(port)};
  if (!server_.watched(key)) return;
  sentences_.clear();
  for (const std::string_view talker : {"GP", "GL", "GA", "GB", "GQ"}) {
    std::vector<nmea::StatedSatellite> seen;
    for (std::size_t i = 0; i < sky.count; ++i) {
      const auto& satellite = sky.satellites[i];
      if (talker_of(satellite.prn) == talker)
        seen.push_back({satellite.prn, satellite.elevation_deg, satellite.azimuth_deg, satellite.cn0_dBHz});
    }
    if (!seen.empty() || talker == "GP") nmea::append_gsv(sentences_, talker, seen);
  }
  server_.publish(key, sentences_);
}

void NmeaFeed::navigation(const pipeline::NavigationSample& sample) {
  is_reckoned_ = sample.source == pipeline::PositionSource::reckoned;
  const NmeaKey key{ReportClass::tpv, navigation_device(settings_)};
  if (!is_reckoned_ || !server_.watched(key)) return;
  nmea::StatedPosition position;
  position.talker = "IN";
  position.fix = instruments::Fix::propagated;
  if (pipeline_.mapping().source != pipeline::UtcMapping::Source::none)
    put_time(position, sample.stamp.validity_utc_ns);
  position.latitude_deg = in_degrees(sample.latitude_rad);
  position.longitude_deg = in_degrees(sample.longitude_rad);
  position.variation_deg = variation_deg();
  if (const auto& velocity_m_s = sample.estimate.velocity_m_s) {
    position.speed_m_s = std::hypot(velocity_m_s->x(), velocity_m_s->y());
    if (*position.speed_m_s > kSlowest_m_s)
      position.course_deg = std::atan2(velocity_m_s->y(), velocity_m_s->x()) * base::kDegreesPerRadian;
  }
  position.north_std_m = sample.estimate.position_std_m.x();
  position.east_std_m = sample.estimate.position_std_m.y();
  sentences_.clear();
  append_position(sentences_, position);
  server_.publish(key, sentences_);
}

NmeaKey NmeaFeed::vehicle_key(std::optional<std::uint16_t> port) const {
  return {ReportClass::att, port.value_or(navigation_device(settings_))};
}

bool NmeaFeed::wants_vehicle(std::optional<std::uint16_t> port) const {
  return server_.watched(vehicle_key(port));
}

void NmeaFeed::append_headings(const instruments::CompassSample* compass, const VehicleState& state) {
  auto heading_std_rad = state.heading_std_rad;
  if (!heading_std_rad && compass != nullptr) heading_std_rad = compass->heading_std_rad;
  const bool is_sure = state.is_north_true && state.heading_rad && heading_std_rad &&
                       *heading_std_rad <= settings_.status.nmea_heading_std_rad;
  if (is_sure) nmea::append_hdt(sentences_, *state.heading_rad * base::kDegreesPerRadian);
  std::optional<double> magnetic_deg;
  // A mis-set unit says more than a circle, which no reader of HDG expects.
  if (compass != nullptr && !compass->heading_is_true && compass->heading_rad && *compass->heading_rad >= 0 &&
      *compass->heading_rad <= 2 * std::numbers::pi) {
    const double sensor_deg = *compass->heading_rad * base::kDegreesPerRadian;
    std::optional<double> deviation_deg;
    if (compass->heading_calibrated_rad)
      deviation_deg = std::remainder(*compass->heading_calibrated_rad * base::kDegreesPerRadian - sensor_deg, 360);
    magnetic_deg = sensor_deg + deviation_deg.value_or(0);
    nmea::append_hdg(sentences_, sensor_deg, deviation_deg, variation_deg());
  }
  if (state.speed_m_s) {
    nmea::append_vhw(sentences_, is_sure ? in_degrees(state.heading_rad) : std::nullopt, magnetic_deg,
                     *state.speed_m_s);
  }
  const auto tilt_std_rad = compass != nullptr ? compass->tilt_std_rad : std::nullopt;
  append_transducers(sentences_, state);
  append_errors(sentences_,
                {heading_std_rad, state.pitch_std_rad ? state.pitch_std_rad : tilt_std_rad, tilt_std_rad});
}

void NmeaFeed::vehicle(std::optional<std::uint16_t> port, const instruments::CompassSample* compass,
                       const VehicleState& state) {
  const NmeaKey key = vehicle_key(port);
  if (!server_.watched(key)) return;
  sentences_.clear();
  append_headings(compass, state);
  if (const auto rate_deg_min = turn_rate_deg_min(state)) nmea::append_rot(sentences_, *rate_deg_min);
  if (state.altitude_m) nmea::append_dpt(sentences_, *state.altitude_m, state.depth_m);
  if (!sentences_.empty()) server_.publish(key, sentences_);
}

}  // namespace navcal::daemon

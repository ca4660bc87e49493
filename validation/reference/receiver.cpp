// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/receiver.h"

#include <chrono>
#include <cmath>

#include "protocols/oncore_encode.h"

namespace navcal::reference {
namespace {

constexpr double kReceiverLatency_s = 0.3;
constexpr double kAntennaUnder_m = 0.35;
constexpr double kLeastSearch_s = 2, kLongestSearch_s = 10;
constexpr double kPositionNoise_m = 1.0, kVelocityNoise_m_s = 0.1;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int8_t kLeapSeconds = 18;
constexpr std::uint8_t kSatellites = 8;

/// Small steps on the ellipsoid, by its radii of curvature.
protocols::oncore::Coordinates on_ellipsoid(const Anchorage& anchorage, const Vector3& place_m) {
  constexpr double a = 6378137.0, f = 1 / 298.257223563, e2 = f * (2 - f);
  const double latitude = anchorage.latitude_deg * kDegree;
  const double root = std::sqrt(1 - e2 * std::sin(latitude) * std::sin(latitude));
  const double north_radius = a * (1 - e2) / (root * root * root) + anchorage.height_m;
  const double east_radius = (a / root + anchorage.height_m) * std::cos(latitude);
  return {anchorage.latitude_deg + place_m.x() / north_radius / kDegree,
          std::remainder(anchorage.longitude_deg + place_m.y() / east_radius / kDegree, 360),
          anchorage.height_m - place_m.z(), std::nullopt};
}

void set_time(protocols::oncore::Position& position, std::int64_t utc_ns) {
  using namespace std::chrono;
  const sys_time<nanoseconds> instant{nanoseconds(utc_ns)};
  const auto day = floor<days>(instant);
  const year_month_day date(day);
  const hh_mm_ss clock(instant - day);
  position.date = {static_cast<std::uint16_t>(static_cast<int>(date.year())),
                   static_cast<std::uint8_t>(static_cast<unsigned>(date.month())),
                   static_cast<std::uint8_t>(static_cast<unsigned>(date.day()))};
  position.time = {static_cast<std::uint8_t>(clock.hours().count()),
                   static_cast<std::uint8_t>(clock.minutes().count()),
                   static_cast<std::uint8_t>(clock.seconds().count()), 0};
}

}  // namespace

Receiver::Receiver(const Fitting& fitting, const GpsDeviations& deviations, const Anchorage& anchorage)
    : Instrument(fitting, Port::gps, 1, kReceiverLatency_s), departures_(deviations), anchorage_(anchorage),
      start_ns_(fitting.start_ns) {
  const std::int64_t to_second_ns = (kSecond_ns - fitting.start_ns % kSecond_ns) % kSecond_ns;
  paced_from(static_cast<double>(to_second_ns) * 1e-9, 1);
  last_.filtered = on_ellipsoid(anchorage, Vector3::Zero());
}

bool Receiver::has_fix(double depth_m, double time_s) {
  const bool was_up = up_;
  up_ = depth_m <= kAntennaUnder_m;
  if (up_ && !was_up) fix_due_s_ = time_s + dice().uniform(kLeastSearch_s, kLongestSearch_s);
  return up_ && time_s >= fix_due_s_;
}

void Receiver::measure(const Snapshot& s) {
  const Vector3 lever(departures_.lever_arm_m.x(), departures_.lever_arm_m.y(), 0);
  const Eigen::Vector2d echo = Eigen::Rotation2Dd(2 * s.heading_rad()) * departures_.multipath_m;
  const Vector3 place =
      s.position_m + s.world_from_body * lever + Vector3(echo.x(), echo.y(), 0) + noise3(kPositionNoise_m);
  const Vector3 velocity = s.ground_velocity_m_s() + s.world_from_body * s.rate_rad_s.cross(lever);
  const double north = velocity.x() + noise(kVelocityNoise_m_s), east = velocity.y() + noise(kVelocityNoise_m_s);
  last_.filtered = on_ellipsoid(anchorage_, place);
  last_.speed_m_s = std::hypot(north, east);
  last_.heading_deg = std::atan2(east, north) / kDegree;
  if (last_.heading_deg < 0) last_.heading_deg += 360;
}

std::vector<std::uint8_t> Receiver::sample(const History& history, double time_s) {
  const bool fixed = has_fix(history.at(time_s).position_m.z(), time_s);
  last_.speed_m_s = last_.heading_deg = 0;
  if (fixed) measure(history.at(time_s - departures_.latency_s));
  set_time(last_, start_ns_ + std::llround(time_s * 1e9));
  last_.unfiltered = last_.filtered;
  last_.speed_3d_m_s = last_.speed_m_s;
  last_.fix = fixed ? protocols::Fix::fix_3d : protocols::Fix::acquiring;
  last_.dop = fixed ? 1.8 : 0;
  last_.visible = last_.tracked = fixed ? kSatellites : std::uint8_t{0};
  last_.few_satellites = !fixed;
  last_.antenna = protocols::oncore::Antenna::ok;
  last_.utc = protocols::oncore::UtcState{true, true, kLeapSeconds};
  last_.channel_count = kSatellites;
  for (std::uint8_t i = 0; i < kSatellites; ++i) {
    last_.channels[i].satellite = static_cast<std::uint8_t>(3 * i + 2);
    last_.channels[i].mode = fixed ? std::uint8_t{8} : std::uint8_t{0};
    last_.channels[i].cn0 = fixed ? std::uint8_t{44} : std::uint8_t{0};
  }
  return protocols::oncore::encode_ha(last_);
}

}  // namespace navcal::reference

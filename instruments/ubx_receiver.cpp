// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/angles.h"
#include "instruments/devices.h"
#include "protocols/ubx_navigation.h"

namespace navcal::instruments {
namespace {

namespace ubx = protocols::ubx;

constexpr std::uint8_t kTimeOnly = 5;  // kind of fix
constexpr int kNoElevation_deg = 90;   // larger ones say that it is unknown

/// Numbers of gpsd: those of GPS as they are, the others in ranges of their own (docs/icd.md, section 6).
std::uint16_t gpsd_number(std::uint8_t gnss, std::uint8_t number) {
  constexpr std::uint8_t kGalileo = 2, kBeiDou = 3, kQzss = 5, kGlonass = 6;
  switch (gnss) {
    case kGalileo: return static_cast<std::uint16_t>(300 + number);
    case kBeiDou: return static_cast<std::uint16_t>(400 + number);
    case kQzss: return static_cast<std::uint16_t>(192 + number);
    case kGlonass: return static_cast<std::uint16_t>(64 + number);
    default:  // GPS, and SBAS with its PRN
      return number;
  }
}

bool can_be(const ubx::NavPvt& pvt) {
  const bool time_can_be = !pvt.date_valid || !pvt.time_valid || pvt.utc_ns().has_value();
  return time_can_be && std::abs(pvt.latitude_deg) <= 90 && std::abs(pvt.longitude_deg) <= 180;
}

void put_position(const ubx::NavPvt& pvt, GpsSample& sample) {
  sample.latitude_rad = pvt.latitude_deg * base::kRadiansPerDegree;
  sample.longitude_rad = pvt.longitude_deg * base::kRadiansPerDegree;
  sample.height_m = pvt.height_m;
  sample.height_msl_m = pvt.height_msl_m;
  // The receiver states the error of the horizontal distance, which has the variances of two axes.
  sample.position_std_m = pvt.horizontal_accuracy_m / std::numbers::sqrt2;
  sample.height_std_m = pvt.vertical_accuracy_m;
}

void put_velocity(const ubx::NavPvt& pvt, double course_gate_m_s, GpsSample& sample) {
  sample.speed_m_s = pvt.ground_speed_m_s;
  if (pvt.ground_speed_m_s >= course_gate_m_s)
    sample.course_rad = pvt.heading_of_motion_deg * base::kRadiansPerDegree;
  sample.climb_m_s = 0 - pvt.velocity_ned_m_s[2];  // no negative zero
  // The speed's error is that of one axis, the one along the course.
  sample.velocity_std_m_s = pvt.speed_accuracy_m_s;
}

SkySample sky_of(const ubx::NavSat& sat) {
  SkySample sky;
  sky.count = std::min(sat.count, SkySample::kMaxSatellites);
  for (std::size_t i = 0; i < sky.count; ++i) {
    const ubx::NavSat::Satellite& from = sat.satellites[i];
    SkySample::Satellite& satellite = sky.satellites[i];
    satellite.prn = gpsd_number(from.gnss, from.number);
    if (std::abs(from.elevation_deg) <= kNoElevation_deg) {
      satellite.elevation_deg = from.elevation_deg;
      satellite.azimuth_deg = from.azimuth_deg;
    }
    if (from.cn0_dBHz > 0) satellite.cn0_dBHz = from.cn0_dBHz;
    satellite.used = from.used;
  }
  return sky;
}

/// An angle with an accuracy that a vehicle can use.
std::optional<double> usable_rad(double angle_deg, double accuracy_deg) {
  constexpr double kWorst_deg = 30;
  if (accuracy_deg <= 0 || accuracy_deg > kWorst_deg || std::abs(angle_deg) > 360) return std::nullopt;
  return angle_deg * base::kRadiansPerDegree;
}

Verdict read_attitude(const ubx::NavAttitude& attitude, Receiver& receiver) {
  const auto& errors_deg = attitude.accuracies_deg;
  const auto angle = [&](std::size_t i) { return usable_rad(attitude.angles_deg[i], errors_deg[i]); };
  CompassSample sample;
  if (const auto roll_rad = angle(0), pitch_rad = angle(1); roll_rad && pitch_rad) {
    sample.roll_rad = roll_rad;
    sample.pitch_rad = pitch_rad;
    sample.tilt_std_rad = std::max(errors_deg[0], errors_deg[1]) * base::kRadiansPerDegree;
  }
  if (const auto heading_rad = angle(2)) {
    sample.heading_rad = base::as_heading(*heading_rad);
    sample.heading_is_true = true;
    sample.heading_std_rad = errors_deg[2] * base::kRadiansPerDegree;
  }
  if (!sample.heading_rad && !sample.tilt_std_rad) return Verdict::ignored;
  hand_over(sample, receiver, false);
  return Verdict::used;
}

Verdict read_relative(const ubx::RelativePosition& relative, Receiver& receiver) {
  constexpr const char* kNames[] = {"relative north", "relative east", "relative down"};
  for (std::size_t i = 0; i < 3 && relative.position_valid; ++i) {
    hand_over(
        ScalarSample{Text<24>(kNames[i]), Text<16>("m"), relative.position_ned_m[i], relative.accuracies_m[i]},
        receiver, false);
  }
  const auto verdict = read_attitude(relative.line, receiver);
  return relative.position_valid ? Verdict::used : verdict;
}

/// Passes on position and satellites of NMEA sentences, or only looks at their times.
class NmeaGate : public Receiver {
 public:
  NmeaGate(Receiver& receiver, bool open) : receiver_(receiver), open_(open) {}
  void on_measurement(const Measurement& measurement) override {
    if (measurement.stated_utc_ns) stated_utc_ns = measurement.stated_utc_ns;
    if (open_) receiver_.on_measurement(measurement);
  }
  std::optional<std::int64_t> stated_utc_ns;

 private:
  Receiver& receiver_;
  bool open_;
};

/// u-blox receiver: one sample for each NAV-PVT, satellites in view from NAV-SAT; attitude from NAV-ATT, HNR-ATT
/// and the line between two antennas (NAV-RELPOSNED); propagated positions from HNR-PVT. NMEA on the same port is
/// read only while no NAV-PVT comes: once its sentences state times kNmeaPatience_ns apart without one between
/// them.
class UbxReceiver final : public Instrument {
 public:
  static constexpr std::int64_t kNmeaPatience_ns = 3'000'000'000;
  /// A receiver whose own estimate of its time error is larger than this does not set our clock.
  static constexpr double kTimeAccuracy_s = 1e-3;

  explicit UbxReceiver(const config::PortSettings& settings)
      : course_gate_m_s_(settings.gps.course_gate_m_s), nmea_(make_nmea(settings)) {}

  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    if (ubx::kind_of(frame) == ubx::Kind::nmea) return read_nmea(frame, receiver);
    switch (ubx::code_of(frame).value_or(0)) {
      case ubx::kNavPvt: {
        const auto pvt = ubx::decode_nav_pvt(frame.bytes);
        return pvt ? read_pvt(*pvt, true, receiver) : Verdict::out_of_range;
      }
      case ubx::kNavTimeGps: {
        const auto time = ubx::decode_nav_timegps(frame.bytes);
        if (!time) return Verdict::out_of_range;
        leap_valid_ = time->leap_valid;
        return Verdict::used;
      }
      case ubx::kNavDop:
        dop_ = ubx::decode_nav_dop(frame.bytes);
        return dop_ ? Verdict::used : Verdict::out_of_range;
      case ubx::kNavSat: {
        const auto sat = ubx::decode_nav_sat(frame.bytes);
        if (!sat) return Verdict::out_of_range;
        hand_over(sky_of(*sat), receiver, false);
        return Verdict::used;
      }
      case ubx::kNavRelPosNed: {
        const auto relative = ubx::decode_nav_relposned(frame.bytes);
        return relative ? read_relative(*relative, receiver) : Verdict::out_of_range;
      }
      case ubx::kNavAtt:
      case ubx::kHnrAtt: {
        const auto attitude = ubx::decode_attitude(frame.bytes);
        return attitude ? read_attitude(*attitude, receiver) : Verdict::out_of_range;
      }
      case ubx::kHnrPvt: {
        const auto pvt = ubx::decode_hnr_pvt(frame.bytes);
        return pvt ? read_pvt(*pvt, false, receiver) : Verdict::out_of_range;
      }
      default: return Verdict::ignored;
    }
  }

 private:
  /// A position that inertial sensors carry on between two epochs is no fix: its errors are those of the epochs.
  Verdict read_pvt(const ubx::NavPvt& pvt, bool is_epoch, Receiver& receiver) {
    if (is_epoch) {
      nmea_since_ns_.reset();
      use_nmea_ = false;
    }
    if (!can_be(pvt)) return Verdict::out_of_range;
    GpsSample sample;
    sample.time_utc_ns = pvt.utc_ns();
    sample.leap_known = leap_known(pvt);
    sample.fix = pvt.fix();
    if (is_epoch) sample.tracked = pvt.satellites;
    if (sample.fix != Fix::none) {
      put_position(pvt, sample);
      put_velocity(pvt, course_gate_m_s_, sample);
      if (is_epoch) {
        sample.dop = sample.fix == Fix::fix_2d && dop_ ? dop_->horizontal : pvt.pdop;
      } else {
        sample.fix = Fix::propagated;
        sample.climb_m_s.reset();
      }
    }
    const bool has_time = sample.fix != Fix::none || (pvt.fix_ok && pvt.fix_type == kTimeOnly);
    receiver.on_measurement({.value = sample,
                             .stated_utc_ns = sample.time_utc_ns,
                             .utc_is_known = is_epoch && sample.time_utc_ns && sample.leap_known && has_time &&
                                             pvt.time_accuracy_s <= kTimeAccuracy_s,
                             .in_leap_second = pvt.second == 60,
                             .paces = is_epoch});
    return Verdict::used;
  }

  /// Without the leap seconds a receiver reports GPS time less the offset that its firmware was made with. The
  /// flag of NAV-PVT is then not set; NAV-TIMEGPS says it more narrowly where it is sent.
  [[nodiscard]] bool leap_known(const ubx::NavPvt& pvt) const {
    return pvt.fully_resolved && leap_valid_.value_or(true);
  }

  Verdict read_nmea(const protocols::Frame& frame, Receiver& receiver) {
    NmeaGate gate(receiver, use_nmea_);
    const Verdict verdict = nmea_->read(frame, gate);
    if (gate.stated_utc_ns) {
      if (!nmea_since_ns_) nmea_since_ns_ = gate.stated_utc_ns;
      // Times that go back are those of a receiver that has begun anew.
      if (*gate.stated_utc_ns < *nmea_since_ns_) nmea_since_ns_ = gate.stated_utc_ns;
      use_nmea_ = *gate.stated_utc_ns - *nmea_since_ns_ >= kNmeaPatience_ns;
    }
    if (use_nmea_ || verdict == Verdict::out_of_range) return verdict;
    return Verdict::ignored;
  }

  double course_gate_m_s_;
  std::optional<bool> leap_valid_;  ///< by the newest NAV-TIMEGPS
  std::optional<protocols::ubx::NavDop> dop_;
  std::optional<std::int64_t> nmea_since_ns_;  ///< UTC of the first NMEA time after the newest NAV-PVT
  bool use_nmea_ = false;
  std::unique_ptr<Instrument> nmea_;
};

}  // namespace

std::unique_ptr<Instrument> make_ubx(const config::PortSettings& settings) {
  return std::make_unique<UbxReceiver>(settings);
}

}  // namespace navcal::instruments

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/angles.h"
#include "instruments/devices.h"
#include "protocols/mip.h"

namespace navcal::instruments {
namespace {

namespace mip = protocols::mip;

/// Beyond what any sensor of this family measures: 900 deg/s, 40 g, 8 gauss, with a margin.
constexpr double kMostRate_rad_s = 35, kMostForce_m_s2 = 800, kMostField_uT = 1600;
constexpr double kMostAngle_rad = 1.001 * std::numbers::pi;
/// A heading whose stated error is larger is none: a filter without any reference of north states pi.
constexpr double kMostHeadingStd_rad = 0.5;
/// Age up to which the filter's tilt belongs to a reading of the field.
constexpr std::int64_t kTiltAge_ns = 20'000'000;
constexpr double kLongestInterval_s = 1;
/// Filter states below this one are start-up and initialisation.
constexpr std::uint16_t kFilterRuns = 2;
constexpr double kWeek_s = 604800;

bool is_within(const std::optional<mip::Triple>& value, double most) {
  return !value || std::all_of(value->begin(), value->end(), [&](double one) { return std::abs(one) <= most; });
}

/// Not-a-number is within no limit.
bool is_possible(const mip::Packet& packet) {
  return is_within(packet.acceleration_m_s2, kMostForce_m_s2) && is_within(packet.rate_rad_s, kMostRate_rad_s) &&
         is_within(packet.field_uT, kMostField_uT) && is_within(packet.delta_theta_rad, kMostRate_rad_s) &&
         is_within(packet.delta_velocity_m_s, kMostForce_m_s2) && is_within(packet.euler_rad, kMostAngle_rad) &&
         is_within(packet.filter_euler_rad, kMostAngle_rad);
}

/// Reference time, else GPS time, which older devices count from their start-up until they have satellites.
std::optional<std::int64_t> device_time_of(const mip::Packet& packet) {
  constexpr std::uint64_t kMost_ns = std::uint64_t{1} << 62;
  if (packet.reference_time_ns) {
    if (*packet.reference_time_ns > kMost_ns) return std::nullopt;
    return static_cast<std::int64_t>(*packet.reference_time_ns);
  }
  if (!packet.gps_time) return std::nullopt;
  const double of_week_s = packet.gps_time->time_of_week_s;
  if (!(of_week_s >= 0 && of_week_s <= kWeek_s)) return std::nullopt;
  constexpr std::int64_t kWeek_ns = 604'800'000'000'000;
  return packet.gps_time->week * kWeek_ns + std::llround(of_week_s * 1e9);
}

std::optional<double> error_of(double std) {
  return std > 0 && std::isfinite(std) ? std::optional(std) : std::nullopt;
}

Vector3 divided(const mip::Triple& increment, double interval_s) {
  return {increment[0] / interval_s, increment[1] / interval_s, increment[2] / interval_s};
}

/// MicroStrain inertial sensor (ICD section 7). Each packet's time of validity is the device's reference time.
///
/// Sensor data (set 80): rates and specific force as ImuSample, field and tilt as CompassSample. Filter data (set
/// 82): attitude with its standard errors as CompassSample. The filter's heading is taken for true: the filter
/// corrects it by the declination that the device is configured with. While the filter gives a heading, that of
/// the complementary filter in set 80, which is magnetic, is left out.
///
/// The pressure is that of the air in the vehicle and no depth.
class MipSensor final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    const mip::Packet packet = mip::decode(frame.bytes);
    if (packet.set != mip::kSensorSet && packet.set != mip::kFilterSet) return Verdict::ignored;
    if (!is_possible(packet)) return Verdict::out_of_range;
    return packet.set == mip::kSensorSet ? read_sensor(packet, receiver) : read_filter(packet, receiver);
  }

 private:
  /// The filter has lost its heading after so many packets of sensor data without one.
  static constexpr int kHeadingLost = 200;

  struct Tilt {
    double roll_rad = 0, pitch_rad = 0;
    std::int64_t device_time_ns = 0;
  };

  Verdict read_sensor(const mip::Packet& packet, Receiver& receiver) {
    packets_since_heading_ = std::min(packets_since_heading_ + 1, kHeadingLost);
    const auto device_time_ns = device_time_of(packet);
    ImuSample imu;
    imu.rate_rad_s = packet.rate_rad_s;
    imu.specific_force_m_s2 = packet.acceleration_m_s2;
    auto imu_time_ns = device_time_ns;
    const auto interval = interval_s(packet, device_time_ns);
    if (!imu.rate_rad_s && !imu.specific_force_m_s2 && interval) {
      if (packet.delta_theta_rad) imu.rate_rad_s = divided(*packet.delta_theta_rad, *interval);
      if (packet.delta_velocity_m_s) imu.specific_force_m_s2 = divided(*packet.delta_velocity_m_s, *interval);
      // A mean over the interval is valid at its middle.
      if (imu_time_ns) *imu_time_ns -= std::llround(*interval * 5e8);
    }
    const bool has_imu = imu.rate_rad_s || imu.specific_force_m_s2;
    if (has_imu) {
      sensor_paces_ = true;
      receiver.on_measurement({.value = imu, .device_time_ns = imu_time_ns});
    }
    const CompassSample compass = compass_of(packet, device_time_ns);
    const bool has_compass = compass.field_body_uT || compass.roll_rad;
    if (has_compass)
      receiver.on_measurement({.value = compass, .device_time_ns = device_time_ns, .paces = !sensor_paces_});
    return has_imu || has_compass ? Verdict::used : Verdict::ignored;
  }

  Verdict read_filter(const mip::Packet& packet, Receiver& receiver) {
    if (!packet.filter_euler_rad || packet.filter_state.value_or(kFilterRuns) < kFilterRuns)
      return Verdict::ignored;
    const mip::Triple& euler_rad = *packet.filter_euler_rad;
    CompassSample compass;
    compass.roll_rad = euler_rad[0];
    compass.pitch_rad = euler_rad[1];
    if (const auto& std_rad = packet.filter_euler_std_rad) {
      compass.tilt_std_rad = error_of(std::max((*std_rad)[0], (*std_rad)[1]));
      compass.heading_std_rad = error_of((*std_rad)[2]);
    }
    if (compass.heading_std_rad.value_or(0) <= kMostHeadingStd_rad) {
      compass.heading_rad = base::as_heading(euler_rad[2]);
      compass.heading_is_true = true;
      packets_since_heading_ = 0;
    } else {
      compass.heading_std_rad.reset();
    }
    const auto device_time_ns = device_time_of(packet);
    if (device_time_ns) filter_tilt_ = Tilt{euler_rad[0], euler_rad[1], *device_time_ns};
    receiver.on_measurement({.value = compass, .device_time_ns = device_time_ns, .paces = !sensor_paces_});
    return Verdict::used;
  }

  /// Time over which the increments of a packet were summed: as it states, else since the packet before.
  [[nodiscard]] std::optional<double> interval_s(const mip::Packet& packet,
                                                 std::optional<std::int64_t> device_time_ns) {
    std::optional<double> interval_s;
    if (packet.reference_delta_ns) {
      interval_s = 1e-9 * static_cast<double>(*packet.reference_delta_ns);
    } else if (packet.delta_time_s) {
      interval_s = packet.delta_time_s;
    } else if (increments_ns_ && device_time_ns) {
      interval_s = 1e-9 * static_cast<double>(*device_time_ns - *increments_ns_);
    }
    if (packet.delta_theta_rad || packet.delta_velocity_m_s) increments_ns_ = device_time_ns;
    if (interval_s && !(*interval_s > 0 && *interval_s < kLongestInterval_s)) return std::nullopt;
    return interval_s;
  }

  /// A device without a complementary filter gives the tilt in its filter packets only. The field needs it at its
  /// own time; the newest is at most one filter period old.
  [[nodiscard]] CompassSample compass_of(const mip::Packet& packet,
                                         std::optional<std::int64_t> device_time_ns) const {
    CompassSample compass;
    compass.field_body_uT = packet.field_uT;
    if (packet.euler_rad) {
      compass.roll_rad = (*packet.euler_rad)[0];
      compass.pitch_rad = (*packet.euler_rad)[1];
      if (packets_since_heading_ >= kHeadingLost) compass.heading_rad = base::as_heading((*packet.euler_rad)[2]);
    } else if (packet.field_uT && filter_tilt_ && device_time_ns &&
               std::abs(*device_time_ns - filter_tilt_->device_time_ns) <= kTiltAge_ns) {
      compass.roll_rad = filter_tilt_->roll_rad;
      compass.pitch_rad = filter_tilt_->pitch_rad;
    }
    return compass;
  }

  bool sensor_paces_ = false;  ///< rates or forces have come in set 80
  /// Packets of set 80 since the filter gave a heading.
  int packets_since_heading_ = kHeadingLost;
  std::optional<Tilt> filter_tilt_;
  std::optional<std::int64_t> increments_ns_;  ///< device time of the newest increments
};

}  // namespace

std::unique_ptr<Instrument> make_mip(const config::PortSettings&) { return std::make_unique<MipSensor>(); }

}  // namespace navcal::instruments

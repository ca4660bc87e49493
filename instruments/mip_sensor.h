// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"
#include "protocols/mip.h"

namespace navcal::instruments {

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
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  /// The filter has lost its heading after so many packets of sensor data without one.
  static constexpr int kHeadingLost = 200;

  struct Tilt {
    double roll_rad = 0, pitch_rad = 0;
    std::int64_t device_time_ns = 0;
  };
  Verdict read_sensor(const protocols::mip::Packet& packet, Receiver& receiver);
  Verdict read_filter(const protocols::mip::Packet& packet, Receiver& receiver);
  [[nodiscard]] std::optional<double> interval_s(const protocols::mip::Packet& packet,
                                                 std::optional<std::int64_t> device_time_ns);
  [[nodiscard]] CompassSample compass_of(const protocols::mip::Packet& packet,
                                         std::optional<std::int64_t> device_time_ns) const;

  bool sensor_paces_ = false;  ///< rates or forces have come in set 80
  /// Packets of set 80 since the filter gave a heading.
  int packets_since_heading_ = kHeadingLost;
  std::optional<Tilt> filter_tilt_;
  std::optional<std::int64_t> increments_ns_;  ///< device time of the newest increments
};

}  // namespace navcal::instruments

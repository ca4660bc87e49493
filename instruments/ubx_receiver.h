// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "instruments/instrument.h"
#include "instruments/nmea_device.h"
#include "protocols/ubx_navigation.h"

namespace navcal::instruments {

/// u-blox receiver: one sample for each NAV-PVT, satellites in view from NAV-SAT; attitude from NAV-ATT, HNR-ATT
/// and the line between two antennas (NAV-RELPOSNED); propagated positions from HNR-PVT. NMEA on the same port is
/// read only while no NAV-PVT comes: once its sentences state times kNmeaPatience_ns apart without one between
/// them.
class UbxReceiver : public Instrument {
 public:
  static constexpr std::int64_t kNmeaPatience_ns = 3'000'000'000;
  /// A receiver whose own estimate of its time error is larger than this does not set our clock.
  static constexpr double kTimeAccuracy_s = 1e-3;

  explicit UbxReceiver(const config::PortSettings& settings);
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  Verdict read_pvt(const protocols::ubx::NavPvt& pvt, bool is_epoch, Receiver& receiver);
  [[nodiscard]] bool leap_known(const protocols::ubx::NavPvt& pvt) const;
  Verdict read_nmea(const protocols::Frame& frame, Receiver& receiver);

  double course_gate_m_s_;
  std::optional<bool> leap_valid_;  ///< by the newest NAV-TIMEGPS
  std::optional<protocols::ubx::NavDop> dop_;
  std::optional<std::int64_t> nmea_since_ns_;  ///< UTC of the first NMEA time after the newest NAV-PVT
  bool use_nmea_ = false;
  NmeaDevice nmea_;
};

}  // namespace navcal::instruments

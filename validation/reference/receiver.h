// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/oncore_position.h"
#include "validation/reference/instrument.h"

namespace navcal::reference {

/// Origin of the coordinates north, east, down (WGS84).
struct Anchorage {
  double latitude_deg = 37.0629, longitude_deg = -80.6275, height_m = 562;
};

/// Motorola Oncore (ICD section 2, message Ha at 1 Hz): position, speed and course over ground of the antenna, on
/// the second, 300 ms before the first byte. Only above 0.35 m depth, and 2 to 10 s after surfacing or power-on.
///     p + R l + A(2 psi)      v + R (w x l)      both `latency` older than the time that they state
class Receiver final : public Instrument {
 public:
  Receiver(const Fitting& fitting, const GpsDeviations& deviations, const Anchorage& anchorage);

 private:
  std::vector<std::uint8_t> sample(const History& history, double time_s) override;
  [[nodiscard]] bool has_fix(double depth_m, double time_s);
  void measure(const Snapshot& s);

  GpsDeviations departures_;
  Anchorage anchorage_;
  std::int64_t start_ns_;
  bool up_ = false;       ///< near the surface
  double fix_due_s_ = 0;  ///< when up
  protocols::oncore::Position last_;
};

}  // namespace navcal::reference

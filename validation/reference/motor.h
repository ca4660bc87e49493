// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validation/reference/instrument.h"
#include "validation/reference/world.h"

namespace navcal::reference {

/// Motor card (ICD section 4): shaft speed, angles of the servos' shafts, current; 10 Hz, 5 ms from measurement to
/// the first byte. It takes the helmsman's orders as they can be written: whole rpm, tenths of a degree.
class Motor final : public Instrument {
 public:
  explicit Motor(const Fitting& fitting);

  /// Writes the order to the card, when it is a new one, and sets servos and shaft going.
  void order(double shaft_rev_s, const Vector3& fins_rad, World& world, std::vector<Transfer>& out);

 private:
  std::vector<std::uint8_t> sample(const History& history, double time_s) override;

  std::int64_t start_ns_;
  int rpm_ = 0;
  Eigen::Vector3i tenths_deg_ = Eigen::Vector3i::Zero();
  std::uint8_t sequence_;
};

}  // namespace navcal::reference

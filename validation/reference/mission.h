// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "validation/reference/receiver.h"
#include "validation/reference/vehicle.h"
#include "validation/reference/waters.h"

namespace navcal::reference {

/// Commands from a time on, until the next order. Without a target for an instrument, fins or shaft are set
/// directly.
struct Order {
  double from_s = 0;
  std::optional<double> heading_rad{};  ///< true, as the compass has it; else the rudder stays
  double rudder_rad = 0;                ///< positive to starboard
  std::optional<double> depth_m{};      ///< as the card has it; else the elevator stays
  double elevator_rad = 0;              ///< positive raises the nose
  std::optional<double> speed_m_s{};    ///< by the shaft speed that should give it; else the shaft speed stays
  double shaft_rev_s = 0;
  Vector3 fins_beside_rad = Vector3::Zero();  ///< of each fin, beside what rudder and elevator ask of it
};

/// A mission as its caller writes it down: this room reads no files.
struct Mission {
  std::int64_t start_ns = 0;  ///< UTC: power-on
  double duration_s = 600;
  Start start;
  std::vector<Order> orders;  ///< in order of time; before the first nothing turns
  Anchorage anchorage;
  Waters waters;
};

}  // namespace navcal::reference

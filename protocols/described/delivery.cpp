// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/delivery.h"

namespace navcal::protocols::described {

Delivery delivery_of(const Description& description) {
  const auto sends = [&](Meaning meaning) { return has(description, meaning); };
  Delivery delivers;
  delivers.field = sends(Meaning::field_x);
  delivers.heading = delivers.field || sends(Meaning::heading) || sends(Meaning::heading_true);
  delivers.rates = sends(Meaning::rate_x);
  delivers.acceleration = sends(Meaning::specific_force_x);
  delivers.depth = sends(Meaning::depth) || sends(Meaning::pressure);
  delivers.position = sends(Meaning::latitude);
  delivers.velocity = sends(Meaning::speed);
  delivers.shaft = sends(Meaning::rpm);
  delivers.altitude = sends(Meaning::altitude);
  delivers.bottom_velocity = sends(Meaning::bottom_velocity_x) || sends(Meaning::bottom_velocity_north);
  delivers.water_velocity = sends(Meaning::water_velocity_x) || sends(Meaning::water_velocity_north);
  return delivers;
}

}  // namespace navcal::protocols::described

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/trax.h"
#include "tests/protocols/mip_samples.h"

// Random frames of a TRAX compass.
namespace navcal::protocols::test {

inline trax::Data random_trax_data(Random& random) {
  trax::Data data;
  data.heading_deg = perhaps(random, random_float(random, 360));
  data.pitch_deg = perhaps(random, random_float(random, 90));
  data.roll_deg = perhaps(random, random_float(random, 180));
  data.temperature_C = perhaps(random, random_float(random, 40));
  for (auto& one : data.field_uT) one = perhaps(random, random_float(random, 60));
  for (auto& one : data.acceleration_m_s2) one = perhaps(random, random_float(random, 2) * 9.80665);
  for (auto& one : data.rate_rad_s) one = perhaps(random, random_float(random, 3));
  data.distorted = perhaps(random, chance(random));
  data.calibrated = perhaps(random, chance(random));
  data.heading_status = perhaps(random, static_cast<std::uint8_t>(below(random, 4)));
  if (chance(random)) data.quaternion = {random_float(random, 1), 0, random_float(random, 1), 1};
  return data;
}

template <>
inline Buffer random_frame<trax::Scanner>(Random& random) {
  if (chance(random)) return trax::encode_data(random_trax_data(random));
  return trax::encode_sample_count(static_cast<std::uint32_t>(below(random, 50)));
}

}  // namespace navcal::protocols::test

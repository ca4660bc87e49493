// SPDX-License-Identifier: Apache-2.0
// Readings of any content and order: the navigator neither crashes nor says what is no number.
#include "nav/navigator.h"

#include <cmath>
#include <cstdlib>

#include "tests/fuzz/source.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::navigator_target {

using namespace navcal::nav;
using navcal::fuzz::Source;

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const Estimate& e) {
  require(!e.heading_rad || (*e.heading_rad >= 0 && *e.heading_rad < 6.2831853072));
  require(!e.pitch_rad || std::abs(*e.pitch_rad) < 1.5708);
  require(!e.roll_rad || std::abs(*e.roll_rad) < 3.1416);
  require(!e.depth_m || std::isfinite(*e.depth_m));
  require(!e.position_m || e.position_m->allFinite());
  require(!e.velocity_m_s || e.velocity_m_s->allFinite());
  require(e.set_m_s.allFinite() && std::isfinite(e.heading_std_rad));
  require((e.position_std_m.array() >= 0).all() && e.position_std_m.allFinite());
}

NAVCAL_FUZZ(navigator) {
  Source source({data, size});
  Navigator navigator({});
  std::int64_t time_ns = 0;
  while (!source.empty()) {
    const auto kind = source.take<std::uint8_t>();
    time_ns += (kind < 16 ? std::int64_t{1'000'000'000} : 1'000'000) * source.take<std::int8_t>();
    switch (kind % 4) {
      case 0: {
        CompassReading reading;
        reading.time_ns = time_ns;
        if (kind & 16) reading.heading_rad = source.number(4);
        if (kind & 32) reading.pitch_rad = source.number(1);
        if (kind & 32) reading.roll_rad = source.number(1);
        navigator.take(reading);
        break;
      }
      case 1: {
        RateReading reading;
        reading.time_ns = time_ns;
        for (double& rate : reading.rate_rad_s) rate = source.number(2);
        reading.depth_m = source.number(10);
        navigator.take(reading);
        break;
      }
      case 2: {
        FixReading reading;
        reading.time_ns = time_ns;
        for (double& axis : reading.position_m) axis = source.number(1000);
        if (kind & 16) reading.velocity_m_s = Eigen::Vector2d(source.number(2), source.number(2));
        navigator.take(reading);
        break;
      }
      default: navigator.take(ShaftReading{time_ns, source.number(20)});
    }
    check(navigator.estimate());
  }
  return 0;
}

}  // namespace navcal::fuzz::navigator_target

// SPDX-License-Identifier: Apache-2.0
#include "instruments/keller_gauge.h"

#include <cmath>

#include "protocols/keller.h"

namespace navcal::instruments {

Instrument::Verdict KellerGauge::read(const protocols::Frame& frame, Receiver& receiver) {
  namespace keller = protocols::keller;
  constexpr double kBar_Pa = 1e5;
  const auto reading = keller::decode_reading(frame.bytes);
  if (!reading) return Verdict::ignored;
  const double pressure_Pa = double{reading->value} * kBar_Pa;
  if (reading->failed(keller::kPressureChannel) || !std::isfinite(pressure_Pa)) return Verdict::out_of_range;
  DepthSample sample;
  sample.pressure_Pa = pressure_Pa;
  hand_over(sample, receiver);
  return Verdict::used;
}

}  // namespace navcal::instruments

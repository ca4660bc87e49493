// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "instruments/devices.h"
#include "protocols/keller.h"

namespace navcal::instruments {

/// Keller pressure transmitter (ICD section 15): answers to F73 as pressure. The transmitter must be one that
/// measures absolute pressure (PAA). Answers do not name their channel: only the pressure channel is ever asked
/// for.
Verdict read_keller(const protocols::Frame& frame, const config::PortSettings&, Receiver& receiver) {
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

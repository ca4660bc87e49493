// SPDX-License-Identifier: Apache-2.0
#include "protocols/motor_card.h"

#include "base/angles.h"
#include "instruments/devices.h"
#include "instruments/units.h"

namespace navcal::instruments {

/// Motor controller: shaft speed, angles of the fin servos, current (ICD section 4).
Verdict read_motor_card(const protocols::Frame& frame, const config::PortSettings&, Receiver& receiver) {
  if (frame.id != protocols::motor_card::kMcs) return Verdict::ignored;
  const auto status = protocols::motor_card::decode_status(frame.bytes);
  if (!status) return Verdict::out_of_range;
  MotorSample sample;
  sample.rpm_commanded = status->rpm_commanded;
  sample.rpm = status->rpm;
  for (std::size_t i = 0; i < sample.fins_rad.size(); ++i) {
    if (status->fins_deg[i]) sample.fins_rad[i] = *status->fins_deg[i] * base::kRadiansPerDegree;
  }
  sample.current_A = status->current_A;
  sample.sequence = status->sequence;

  receiver.on_measurement({.value = sample, .sequence = status->sequence});
  return Verdict::used;
}

}  // namespace navcal::instruments

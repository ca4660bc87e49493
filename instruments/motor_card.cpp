// SPDX-License-Identifier: Apache-2.0
#include "instruments/motor_card.h"

#include "base/angles.h"
#include "instruments/units.h"
#include "protocols/motor_card.h"

namespace navcal::instruments {

Instrument::Verdict MotorCard::read(const protocols::Frame& frame, Receiver& receiver) {
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

  Measurement measurement;
  measurement.value = sample;
  measurement.sequence = status->sequence;
  receiver.on_measurement(measurement);
  return Verdict::used;
}

}  // namespace navcal::instruments

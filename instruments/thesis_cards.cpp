// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "instruments/devices.h"
#include "instruments/units.h"
#include "protocols/imu_card.h"
#include "protocols/motor_card.h"

namespace navcal::instruments {

namespace card = protocols::imu_card;

/// Inertial card: 1/16 converter counts (1 count = 1 mV) to rates, specific force and depth by per-unit zeros and
/// scales (ICD section 3).
Verdict read_imu_card(const protocols::Frame& frame, const config::PortSettings& settings, Receiver& receiver) {
  const auto record = card::decode_record(frame.bytes);
  if (!record) return Verdict::ignored;
  const auto scaled = [&](std::size_t channel) {
    return (record->raw[channel] / 16.0 - settings.imu_card.zero_mV[channel]) / settings.imu_card.scale[channel];
  };
  ImuSample sample;
  sample.rate_rad_s = Vector3{scaled(0) * base::kRadiansPerDegree, scaled(2) * base::kRadiansPerDegree,
                              scaled(1) * base::kRadiansPerDegree};
  sample.yaw_rate_b_rad_s = scaled(3) * base::kRadiansPerDegree;
  sample.specific_force_m_s2 =
      Vector3{scaled(4) * kGravity_m_s2, scaled(5) * kGravity_m_s2, scaled(6) * kGravity_m_s2};
  sample.depth_m = scaled(7);
  sample.over_range = (record->status & card::over_range) != 0;
  sample.card = {.sequence = record->sequence,
                 .leak_forward = (record->status & card::leak_forward) != 0,
                 .leak_aft = (record->status & card::leak_aft) != 0,
                 .low_supply = (record->status & card::low_supply) != 0};

  receiver.on_measurement({.value = sample, .sequence = record->sequence});
  return Verdict::used;
}

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

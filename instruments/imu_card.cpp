// SPDX-License-Identifier: Apache-2.0
#include "instruments/imu_card.h"

#include "base/angles.h"
#include "instruments/units.h"
#include "protocols/imu_card.h"

namespace navcal::instruments {

namespace card = protocols::imu_card;

Instrument::Verdict ImuCard::read(const protocols::Frame& frame, Receiver& receiver) {
  const auto record = card::decode_record(frame.bytes);
  if (!record) return Verdict::ignored;
  const auto scaled = [&](std::size_t channel) {
    return (record->raw[channel] / 16.0 - settings_.zero_mV[channel]) / settings_.scale[channel];
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

  Measurement measurement;
  measurement.value = sample;
  measurement.sequence = record->sequence;
  receiver.on_measurement(measurement);
  return Verdict::used;
}

}  // namespace navcal::instruments

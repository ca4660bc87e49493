// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"
#include "protocols/vectornav.h"

namespace navcal::instruments {

/// VectorNav VN-100, VN-200, VN-300: rates and specific force, attitude and field, and the air pressure inside the
/// sensor. Compensated values are preferred to uncompensated ones of the same message. Yaw is taken for magnetic,
/// as it is with the settings of the factory (ICD section 12).
class VectorNavSensor : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  static Verdict hand_over(const protocols::vectornav::Reading& reading, Receiver& receiver);
};

}  // namespace navcal::instruments

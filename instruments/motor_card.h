// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// Motor controller: shaft speed, angles of the fin servos, current (ICD section 4).
class MotorCard : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;
};

}  // namespace navcal::instruments

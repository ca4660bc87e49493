// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// Water Linked DVL A50 and A125 (ICD section 10): wrz and wrx as velocities over the bottom with their stated
/// errors and the altitude. wrz states when the ping was reflected and when the line was sent, by the instrument's
/// own clock: their difference takes the place of the port's latency. Without bottom lock a sample has neither
/// velocity nor altitude. The dead reckoning wrp and the single beams wru are not used.
class WaterLinkedLog final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;
};

}  // namespace navcal::instruments

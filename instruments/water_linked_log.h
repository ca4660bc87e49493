// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// Water Linked DVL A50 and A125 (ICD section 10): wrz and wrx as velocities over the bottom with their stated
/// errors and the altitude. wrz states when the ping was reflected and when the line was sent, by the instrument's
/// own clock: their difference takes the place of the port's latency. Without bottom lock a sample has neither
/// velocity nor altitude. The altitude is stated along the instrument's axis; the tilt of its dead reckoning, wrp,
/// makes it vertical where wrp comes. Its position, in a frame of its own, is three scalars; the single beams wru
/// are not used. The network port says the same in JSON.
class WaterLinkedLog final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  Verdict read_velocity(protocols::Bytes line, Receiver& receiver);

  double tilt_cosine_ = 1;    ///< of the newest wrp
  int velocities_since_ = 0;  ///< since then
};

}  // namespace navcal::instruments

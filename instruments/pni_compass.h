// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// PNI TRAX, TCM3 and Prime (ICD section 11): heading, tilt, field and temperature as CompassSample, acceleration
/// as ImuSample of the same time. The heading is taken for magnetic, as the start-up dialogue sets it. Distortion
/// is a remark, as the TCM2's E001. The device's heading status is not used: no source at hand says what it means.
class PniCompass final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;
};

}  // namespace navcal::instruments

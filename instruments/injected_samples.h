// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// Samples that another program sends, one JSON object a line (ICD section 13), with the keys of `navcal replay
/// --json`. A line with the members `time` and `time_std` states when it was valid; without `time` its arrival
/// counts. A line that is no flat JSON object, names an unknown class, or has a member of a wrong type or out of
/// range, counts as out of range and gives no sample. Unknown members are ignored, and so are lines of classes
/// that are no measurements.
class InjectedSamples : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;
};

}  // namespace navcal::instruments

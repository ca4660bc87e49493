// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// Keller pressure transmitter (ICD section 15): answers to F73 as pressure. The transmitter must be one that
/// measures absolute pressure (PAA). Answers do not name their channel: only the pressure channel is ever asked
/// for.
class KellerGauge final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;
};

}  // namespace navcal::instruments

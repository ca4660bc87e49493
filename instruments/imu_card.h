// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// Inertial card: 1/16 converter counts (1 count = 1 mV) to rates, specific force and depth by per-unit zeros and
/// scales (ICD section 3).
class ImuCard : public Instrument {
 public:
  explicit ImuCard(const config::ImuCardSettings& settings) : settings_(settings) {}
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  config::ImuCardSettings settings_;
};

}  // namespace navcal::instruments

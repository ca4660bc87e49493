// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// Paroscientific Digiquartz gauge for absolute pressure (ICD section 14). A number does not name its unit: it
/// counts from the answer on that states it (UN), which the start-up dialogue asks for. Without the dialogue the
/// unit is the one of delivery, psi.
class ParoscientificGauge final : public Instrument {
 public:
  explicit ParoscientificGauge(const config::PortSettings& settings);
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  std::optional<double> unit_Pa_;
};

}  // namespace navcal::instruments

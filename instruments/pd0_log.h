// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/error_velocity.h"
#include "instruments/instrument.h"
#include "protocols/pd0.h"

namespace navcal::instruments {

/// Teledyne Doppler log, PD0 (ICD section 8): bottom track in any of its four axes, altitude, and what its own
/// sensors measure of attitude and pressure. Axes of the vehicle are those of the mounted instrument, with its own
/// heading alignment; [port.NAME.mounting] turns further.
class Pd0Log final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  [[nodiscard]] std::optional<double> error_m_s(const std::optional<double>& error_velocity_m_s,
                                                ErrorVelocity& history) const;

  ErrorVelocity bottom_error_, water_error_;
};

}  // namespace navcal::instruments

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/error_velocity.h"
#include "instruments/instrument.h"
#include "protocols/pd6.h"

namespace navcal::instruments {

/// Teledyne Doppler log, PD6 (ICD section 9). The lines of one ping are collected. Its last one, BD, gives the
/// range to the bottom and closes the sample; a ping whose BD is lost gives none. The instrument's axes are
/// preferred (BI, WI), then the Earth's, then the ship's, which may be level or not.
class Pd6Log final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  Verdict read_attitude(protocols::Bytes line, Receiver& receiver);
  Verdict read_timing(protocols::Bytes line);
  Verdict read_velocity(const protocols::pd6::Velocity& velocity);
  Verdict close(protocols::Bytes line, Receiver& receiver);

  /// Velocities of one ping by axes: instrument, Earth, ship.
  struct Ping {
    std::array<std::optional<Vector3>, 3> bottom_m_s, water_m_s;
    std::optional<double> temperature_C, sound_speed_m_s;
  };
  Ping ping_;
  ErrorVelocity bottom_error_, water_error_;
};

}  // namespace navcal::instruments

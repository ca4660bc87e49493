// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/settings.h"
#include "devices/instrument_model.h"
#include "instruments/samples.h"

namespace navcal::pipeline {

/// Gives each sample the standard errors that its device does not state, by the configuration's table
/// [instruments]. They are the noise of one reading: a deviation that a calibration would take away is not in
/// them. Quantities of which the configuration knows nothing stay without.
class StandardErrors {
 public:
  explicit StandardErrors(const config::Settings& settings);

  void complete(instruments::Sample& sample) const;

 private:
  void complete(instruments::CompassSample& compass) const;
  void complete(instruments::ImuSample& imu) const;
  void complete(instruments::GpsSample& gps) const;
  void complete(instruments::MotorSample& motor) const;
  void complete(instruments::AltimeterSample& altimeter) const;
  void complete(instruments::DvlSample& dvl) const;
  template <class Other>
  void complete(Other& /*sample*/) const {}

  devices::InstrumentModel instruments_;
  double heading_std_rad_, tilt_std_rad_, fin_std_rad_;
  double altitude_std_m_, dvl_std_m_s_;
};

}  // namespace navcal::pipeline

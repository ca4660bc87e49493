// SPDX-License-Identifier: Apache-2.0
#include "tests/calib/turn/filtered_turns.h"

#include <cmath>

#include "calib/turn/turn_integrator.h"

namespace navcal::calib::test {

TurnFilter filtered(std::span<const Measured> readings, const TurnPrior& prior) {
  constexpr double kPeriod_s = 0.1;
  TurnFilter::Parameters parameters;
  parameters.heading_noise_rad = Noise{}.heading_rad;
  parameters.rate_noise_rad_sqrt_s = Noise{}.rate_rad_s * std::sqrt(kPeriod_s);
  TurnFilter filter(parameters, prior);
  TurnIntegrator integrator({});
  for (const Measured& m : readings) {
    integrator.update(compass_of(m));
    integrator.update(rate_of(m));
    while (const auto step = integrator.next()) filter.update(*step);
  }
  return filter;
}

}  // namespace navcal::calib::test

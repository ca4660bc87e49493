// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/filtered_turns.h"

#include <cmath>

#include "calib/turn/turn_integrator.h"

namespace navcal::calib::thesis {

TurnFilter turn_filter(const TurnPrior& prior) {
  TurnFilter::Parameters parameters;
  parameters.heading_noise_rad = Noise{}.heading_rad;
  parameters.rate_noise_rad_sqrt_s = Noise{}.rate_rad_s * std::sqrt(kPeriod_s);
  return TurnFilter(parameters, prior);
}

std::vector<TurnStep> turn_steps(std::span<const Measured> readings) {
  TurnIntegrator integrator({});
  std::vector<TurnStep> steps;
  for (const Measured& m : readings) {
    integrator.update(compass_of(m));
    integrator.update(rate_of(m));
    while (const auto step = integrator.next()) steps.push_back(*step);
  }
  return steps;
}

TurnFilter filtered(std::span<const Measured> readings, const TurnPrior& prior) {
  TurnFilter filter = turn_filter(prior);
  for (const TurnStep& step : turn_steps(readings)) filter.update(step);
  return filter;
}

}  // namespace navcal::calib::thesis

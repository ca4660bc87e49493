// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "sim/instruments/device.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

/// A program that sends samples as lines (ICD section 13), each with its time of validity: a Doppler log with
/// bottom lock and a pressure gauge five times a second, and a mission sensor of the water's temperature once a
/// second.
class SampleSender final : public LineDevice {
 public:
  struct Options {
    double velocity_noise_m_s = 0.005;
    double depth_noise_m = 0.01;
    double temperature_noise_C = 0.01;
    std::uint64_t seed = 1;
    int baud = 4'000'000;
  };
  SampleSender(const Options& options, const Motion& motion);

  void power_on(std::int64_t t_ns) override;

 private:
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;

  Options options_;
  const Motion& motion_;
  Noise noise_;
  std::uint64_t sent_ = 0;
};

}  // namespace navcal::sim

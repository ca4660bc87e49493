// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace navcal::instruments {

/// A device whose clock is off and wanders, seen through a host that is late: delays exponential, and now and then
/// a stall. Times in seconds.
class SimulatedDevice {
 public:
  struct Options {
    double rate_Hz = 20;
    double skew = 100e-6;
    double wander = 0.5e-6;  ///< of the frequency, per sqrt(s)
    double jitter_s = 2e-3;
    double stall_s = 30e-3;
    double stall_share = 0.01;
  };
  SimulatedDevice(const Options& options, unsigned seed)
      : options_(options), frequency_(options.skew), random_(seed) {}

  struct Frame {
    double true_s;
    double arrival_s;
  };
  Frame next() {
    const double delay_s = exponential_(random_) * options_.jitter_s +
                           (uniform_(random_) < options_.stall_share ? options_.stall_s : 0.0);
    last_arrival_s_ = std::max(last_arrival_s_, time_s_ + delay_s);
    const Frame frame{time_s_, last_arrival_s_};
    const double dt_s = 1 / options_.rate_Hz;
    frequency_ += options_.wander * std::sqrt(dt_s) * normal_(random_);
    time_s_ += dt_s * (1 + frequency_);
    return frame;
  }

 private:
  Options options_;
  double frequency_;
  double time_s_ = 1000;
  double last_arrival_s_ = 0;
  std::mt19937_64 random_;
  std::exponential_distribution<double> exponential_{1.0};
  std::uniform_real_distribution<double> uniform_;
  std::normal_distribution<double> normal_;
};

}  // namespace navcal::instruments

// Error of time stamps against the true sample times, arrival against model, on simulated arrivals: exponential
// delays, stalls, a device clock that is off and wanders. One table; no input.
#include <fmt/format.h>

#include <chrono>

#include "instruments/clock_model.h"
#include "tests/instruments/clock_simulation.h"

namespace {

using navcal::instruments::ClockModel;
using navcal::instruments::SimulatedDevice;

constexpr int kSeeds = 40;
constexpr double kDuration_s = 600;

struct Row {
  double arrival_rms_s = 0, model_rms_s = 0, within_two_sigma = 0, update_ns = 0;
};

Row measure(const SimulatedDevice::Options& options) {
  Row row;
  long count = 0;
  std::chrono::nanoseconds spent{};
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    SimulatedDevice device(options, 1000 + seed);
    ClockModel clock(1 / options.rate_Hz);
    for (int k = 0; k < static_cast<int>(kDuration_s * options.rate_Hz); ++k, ++count) {
      const auto frame = device.next();
      const auto before = std::chrono::steady_clock::now();
      const auto time = clock.update(k, std::llround(frame.arrival_s * 1e9));
      spent += std::chrono::steady_clock::now() - before;
      const double error_s = static_cast<double>(time.time_ns) * 1e-9 - frame.true_s;
      row.model_rms_s += error_s * error_s;
      row.arrival_rms_s += (frame.arrival_s - frame.true_s) * (frame.arrival_s - frame.true_s);
      row.within_two_sigma += std::abs(error_s) <= 2e-9 * static_cast<double>(time.std_ns) ? 1 : 0;
    }
  }
  const auto n = static_cast<double>(count);
  return {std::sqrt(row.arrival_rms_s / n), std::sqrt(row.model_rms_s / n), row.within_two_sigma / n,
          static_cast<double>(spent.count()) / n};
}

}  // namespace

int main() {
  fmt::print("delays exponential with 2 ms mean, 30 ms stalls 1 %, device clock off by 100 ppm; {} runs of {} s\n",
             kSeeds, kDuration_s);
  fmt::print("{:>8} {:>18} {:>14} {:>12} {:>8} {:>14} {:>12}\n", "rate_Hz", "wander_ppm_sqrt_s", "arrival_rms_us",
             "model_rms_us", "ratio", "within_2_sigma", "ns_update");
  for (const double rate_Hz : {10.0, 20.0, 50.0, 200.0}) {
    for (const double wander : {0.0, 0.3e-6, 1e-6, 3e-6}) {
      SimulatedDevice::Options options;
      options.rate_Hz = rate_Hz;
      options.wander = wander;
      const Row row = measure(options);
      fmt::print("{:8.0f} {:18.1f} {:14.1f} {:12.1f} {:8.4f} {:14.3f} {:12.0f}\n", rate_Hz, wander * 1e6,
                 row.arrival_rms_s * 1e6, row.model_rms_s * 1e6, row.model_rms_s / row.arrival_rms_s,
                 row.within_two_sigma, row.update_ns);
    }
  }
}

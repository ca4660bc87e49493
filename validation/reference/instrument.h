// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "validation/reference/history.h"
#include "validation/reference/rng.h"
#include "validation/reference/sink.h"

namespace navcal::reference {

/// Properties common to all instruments: noise (`noisy` false: none, for tests of equations), clock, line.
struct Fitting {
  std::uint64_t seed = 0;
  bool noisy = true;
  std::int64_t start_ns = 0;     ///< UTC of time 0
  double clock_slow = 0;         ///< share by which a card's period is too long
  double clock_ppm = 30;         ///< one standard deviation of how slow a card's clock runs beside
  double host_delay_s = 0.0001;  ///< mean of the exponential delay of a read

  /// The same of a card with a slow clock of its own.
  [[nodiscard]] Fitting with_clock(double slow) const {
    return {seed, noisy, start_ns, slow, clock_ppm, host_delay_s};
  }
};

/// An instrument that measures and sends at the pace of its own clock: sample k is taken at phase + k * period *
/// (1 + skew), its first byte leaves `latency_s` later, and it is read when its last byte has come and the host
/// got round to it.
class Instrument {
 public:
  Instrument(const Fitting& fitting, Port port, double period_s, double latency_s)
      : fitting_(fitting), dice_(fitting.seed, static_cast<std::uint64_t>(port)), port_(port),
        latency_s_(latency_s),
        period_s_(period_s * (1 + fitting.clock_slow + dice_.normal(fitting.clock_ppm) * 1e-6)),
        phase_s_(dice_.uniform(0, period_s)) {}
  virtual ~Instrument() = default;
  Instrument(const Instrument&) = delete;
  Instrument& operator=(const Instrument&) = delete;

  /// All samples that are taken up to the history's now.
  void catch_up(const History& history, std::vector<Transfer>& out) {
    for (; next_s() <= history.now().time_s; ++taken_) {
      const double time_s = next_s();
      std::vector<std::uint8_t> bytes = sample(history, time_s);
      const double wire_s = 10.0 * static_cast<double>(bytes.size()) / facts_of(port_).baud;
      const double delay_s = latency_s_ + wire_s + dice_.exponential(fitting_.host_delay_s);
      out.push_back({port_, false, fitting_.start_ns + std::llround((time_s + delay_s) * 1e9), std::move(bytes)});
    }
  }

 protected:
  /// The frame of a sample taken at this time.
  virtual std::vector<std::uint8_t> sample(const History& history, double time_s) = 0;

  [[nodiscard]] double noise(double sigma) { return fitting_.noisy ? dice_.normal(sigma) : 0; }
  [[nodiscard]] Vector3 noise3(double sigma) {
    const double x = noise(sigma), y = noise(sigma), z = noise(sigma);
    return {x, y, z};
  }
  [[nodiscard]] Rng& dice() { return dice_; }
  /// The second of time is another's: samples are taken from this time on, exactly.
  void paced_from(double phase_s, double period_s) {
    phase_s_ = phase_s;
    period_s_ = period_s;
  }

 private:
  [[nodiscard]] double next_s() const { return phase_s_ + static_cast<double>(taken_) * period_s_; }

  Fitting fitting_;
  Rng dice_;
  Port port_;
  double latency_s_, period_s_, phase_s_;
  std::int64_t taken_ = 0;
};

inline constexpr double kDegree = 0.017453292519943295;

}  // namespace navcal::reference

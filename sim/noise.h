// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace navcal::sim {

/// Seeded randomness of one device: the same seed and the same questions give the same answers.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : generator_(seed) {}

  [[nodiscard]] double normal(double sigma) { return sigma * normal_(generator_); }
  [[nodiscard]] double uniform(double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(generator_);
  }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

/// Ticks of a device's own clock, which runs `ppm` slow: tick n is at start + n * period * (1 + ppm * 1e-6). What
/// is less than a nanosecond is kept, so that it does not add up.
class Ticks {
 public:
  Ticks() = default;
  Ticks(std::int64_t start_ns, double period_s, double ppm) : next_ns_(start_ns), period_s_(period_s), ppm_(ppm) {
    pass();
  }

  [[nodiscard]] std::int64_t next_ns() const { return next_ns_ + (beyond_ns_ < 0.5 ? 0 : 1); }
  /// `more_ppm`: slower by so much up to the next tick.
  void pass(double more_ppm = 0) {
    const double step_ns = period_s_ * (1e9 + (ppm_ + more_ppm) * 1e3) + beyond_ns_;
    const double whole_ns = std::floor(step_ns);
    next_ns_ += static_cast<std::int64_t>(whole_ns);
    beyond_ns_ = step_ns - whole_ns;
  }

 private:
  std::int64_t next_ns_ = 0;
  double beyond_ns_ = 0;
  double period_s_ = 0, ppm_ = 0;
};

}  // namespace navcal::sim

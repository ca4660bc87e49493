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

/// To the resolution of an instrument.
[[nodiscard]] inline double rounded(double value, double resolution) {
  return std::round(value / resolution) * resolution;
}

/// Ticks of a device's own clock, which runs `ppm` slow: tick n is at start + n * period * (1 + ppm * 1e-6).
class Ticks {
 public:
  Ticks() = default;
  Ticks(std::int64_t start_ns, double period_s, double ppm)
      : start_ns_(start_ns), period_ns_(period_s * (1e9 + ppm * 1e3)) {}

  [[nodiscard]] std::int64_t next_ns() const {
    return start_ns_ + std::llround(static_cast<double>(count_) * period_ns_);
  }
  void pass() { ++count_; }

 private:
  std::int64_t start_ns_ = 0;
  double period_ns_ = 0;
  std::int64_t count_ = 1;
};

}  // namespace navcal::sim

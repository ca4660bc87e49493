// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace navcal::reference {

/// Randomness by seed, the same on every machine: SplitMix64 (Steele, Lea, Flood, OOPSLA 2014) and the transform
/// of Box and Muller. Streams of one seed are independent, so that one instrument's draws do not move another's.
class Rng {
 public:
  Rng(std::uint64_t seed, std::uint64_t stream) : state_(mixed(seed) ^ mixed(~stream)) {}

  [[nodiscard]] std::uint64_t bits() { return mixed(state_ += 0x9E3779B97F4A7C15U); }
  /// In [least, greatest).
  [[nodiscard]] double uniform(double least = 0, double greatest = 1) {
    return least + (greatest - least) * static_cast<double>(bits() >> 11U) * 0x1p-53;
  }
  [[nodiscard]] double normal(double sigma = 1) {
    const double radius = std::sqrt(-2 * std::log1p(-uniform()));
    return sigma * radius * std::cos(2 * std::numbers::pi * uniform());
  }
  [[nodiscard]] double exponential(double mean) { return -mean * std::log1p(-uniform()); }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }
  std::uint64_t state_;
};

}  // namespace navcal::reference

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "analysis/noise/series.h"

// Noise with known parameters. The draws are compiled with optimisation: unoptimised they took longer than what is
// tested.
namespace navcal::analysis::noise_test {

class MadeNoise {
 public:
  explicit MadeNoise(std::uint64_t seed) : state_(seed) {}

  std::vector<double> white(std::size_t count, double std);
  /// `step`: standard deviation of the change from one reading to the next.
  std::vector<double> walk(std::size_t count, double step);
  /// Standard deviation `std`, correlation a from one reading to the next.
  std::vector<double> filtered(std::size_t count, double std, double a);
  /// Flicker noise whose Allan deviation is flat at 0.664 b: a sum of filtered noises, two for each octave of time
  /// constants from one reading to `count` of them.
  std::vector<double> flicker(std::size_t count, double b);

 private:
  [[nodiscard]] double uniform();

  std::uint64_t state_;
};

std::vector<double> sum(std::vector<double> a, const std::vector<double>& b);
std::vector<double> rounded(std::vector<double> values, double step);
std::vector<double> sine(std::size_t count, double amplitude, double cycles_per_reading);
Series series_of(std::vector<double> values, double period_s, double begin_s = 0);

}  // namespace navcal::analysis::noise_test

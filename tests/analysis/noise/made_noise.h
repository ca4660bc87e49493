// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "analysis/noise/series.h"

// Noise with known parameters.
namespace navcal::analysis::noise_test {

class MadeNoise {
 public:
  explicit MadeNoise(unsigned seed) : random_(seed) {}

  std::vector<double> white(std::size_t count, double std) {
    std::vector<double> values(count);
    for (double& value : values) value = std * normal_(random_);
    return values;
  }
  /// `step`: standard deviation of the change from one reading to the next.
  std::vector<double> walk(std::size_t count, double step) {
    auto values = white(count, step);
    for (std::size_t i = 1; i < count; ++i) values[i] += values[i - 1];
    return values;
  }
  /// Standard deviation `std`, correlation a from one reading to the next.
  std::vector<double> filtered(std::size_t count, double std, double a) {
    auto values = white(count, std * std::sqrt(1 - a * a));
    values[0] /= std::sqrt(1 - a * a);
    for (std::size_t i = 1; i < count; ++i) values[i] += a * values[i - 1];
    return values;
  }
  /// Flicker noise whose Allan deviation is flat at 0.664 b: a sum of filtered noises, two for each octave of time
  /// constants from one reading to `count` of them.
  std::vector<double> flicker(std::size_t count, double b) {
    // Terms of variance v whose time constants are a factor r apart have the one-sided power density v / (f ln r).
    // That of flicker noise is B^2 / (pi f).
    std::vector<double> values(count, 0);
    const double ratio = std::sqrt(2.0), std = b * std::sqrt(std::log(ratio) / std::numbers::pi);
    for (double lag = 0.5; lag < static_cast<double>(count); lag *= ratio) {
      const auto term = filtered(count, std, std::exp(-1 / lag));
      for (std::size_t i = 0; i < count; ++i) values[i] += term[i];
    }
    return values;
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

inline std::vector<double> sum(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

inline std::vector<double> rounded(std::vector<double> values, double step) {
  for (double& value : values) value = step * std::round(value / step);
  return values;
}

inline std::vector<double> sine(std::size_t count, double amplitude, double cycles_per_reading) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = amplitude * std::sin(2 * std::numbers::pi * cycles_per_reading * static_cast<double>(i) + 0.3);
  return values;
}

inline Series series_of(std::vector<double> values, double period_s, double begin_s = 0) {
  Series series;
  for (std::size_t i = 0; i < values.size(); ++i)
    series.time_s.push_back(begin_s + static_cast<double>(i) * period_s);
  series.values = std::move(values);
  return series;
}

}  // namespace navcal::analysis::noise_test

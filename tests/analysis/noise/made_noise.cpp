// SPDX-License-Identifier: Apache-2.0
#include "tests/analysis/noise/made_noise.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace navcal::analysis::noise_test {

// No template of the standard library: of those that tests instantiate as well the linker may keep the unoptimised
// one. (SplitMix64; Box and Muller 1958.)
double MadeNoise::uniform() {
  std::uint64_t bits = state_ += 0x9e3779b97f4a7c15;
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111eb;
  return (static_cast<double>((bits ^ bits >> 31) >> 11) + 0.5) * 0x1p-53;
}

std::vector<double> MadeNoise::white(std::size_t count, double std) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; i += 2) {
    const double radius = std * std::sqrt(-2 * std::log(uniform())), angle = 2 * std::numbers::pi * uniform();
    values[i] = radius * std::cos(angle);
    if (i + 1 < count) values[i + 1] = radius * std::sin(angle);
  }
  return values;
}

std::vector<double> MadeNoise::walk(std::size_t count, double step) {
  auto values = white(count, step);
  for (std::size_t i = 1; i < count; ++i) values[i] += values[i - 1];
  return values;
}

std::vector<double> MadeNoise::filtered(std::size_t count, double std, double a) {
  auto values = white(count, std * std::sqrt(1 - a * a));
  values[0] /= std::sqrt(1 - a * a);
  for (std::size_t i = 1; i < count; ++i) values[i] += a * values[i - 1];
  return values;
}

std::vector<double> MadeNoise::flicker(std::size_t count, double b) {
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

std::vector<double> sum(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

std::vector<double> rounded(std::vector<double> values, double step) {
  for (double& value : values) value = step * std::round(value / step);
  return values;
}

std::vector<double> sine(std::size_t count, double amplitude, double cycles_per_reading) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = amplitude * std::sin(2 * std::numbers::pi * cycles_per_reading * static_cast<double>(i) + 0.3);
  return values;
}

Series series_of(std::vector<double> values, double period_s, double begin_s) {
  Series series;
  for (std::size_t i = 0; i < values.size(); ++i)
    series.time_s.push_back(begin_s + static_cast<double>(i) * period_s);
  series.values = std::move(values);
  return series;
}

}  // namespace navcal::analysis::noise_test

// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/held_out.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>

namespace navcal::diagnosis {

ExplainedWindows held_out(const FittedRecording& recording, const RecordingFit& without,
                          const CauseLibrary& library, const ColumnPriors& priors,
                          const CauseSearchResult& found) {
  std::vector<ParameterPrior> means;
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(library.columns());
  ColumnPriors with = priors;
  for (const std::size_t cause : found.sets.front().causes) {
    for (const CauseParameter& parameter : library.causes[cause].parameters) {
      const Eigen::Index column = parameter.column;
      shift[column] = found.mean[column];
      // The mean of a nuisance's prior is zero: it may be as large as it was found.
      const double size = library.causes[cause].is_instrument ? std::abs(found.mean[column]) : 0;
      with.spike[column] = std::max(found.std[column], priors.spike[column]);
      means.push_back(
          {column,
           std::clamp(found.mean[column], parameter.low * parameter.per_unit, parameter.high * parameter.per_unit),
           std::max(with.spike[column], size)});
    }
  }
  ExplainedWindows windows{-std::numeric_limits<double>::infinity(), without.window_power, without.window_power,
                           without.window_readings};
  try {
    const RecordingFit improved = recording.fit(means, &without, [](double) {});
    windows.gain_nats = SetEvidence(improved.linear.about(shift), library, with)({}) -
                        SetEvidence(without.linear, library, priors)({});
    windows.after = improved.window_power;
  } catch (const identify::UnboundedReplay&) {
    // A vehicle with these effects could not have moved as this one did.
  }
  return windows;
}

gap::Closure closure_of(std::span<const ExplainedWindows> recordings, double floor, std::uint64_t seed) {
  std::vector<double> before, after, readings;
  for (const ExplainedWindows& windows : recordings) {
    before.insert(before.end(), windows.before.begin(), windows.before.end());
    after.insert(after.end(), windows.after.begin(), windows.after.end());
    readings.insert(readings.end(), windows.readings.begin(), windows.readings.end());
  }
  const auto closed = [&](const auto& index) -> std::optional<double> {
    double b = 0, a = 0, n = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      b += before[index(i)];
      a += after[index(i)];
      n += readings[index(i)];
    }
    if (b / n <= 1.05 * floor) return std::nullopt;
    return 1 - (a / n - floor) / (b / n - floor);
  };
  const double n = std::accumulate(readings.begin(), readings.end(), 0.0);
  gap::Closure pooled;
  pooled.before = std::accumulate(before.begin(), before.end(), 0.0) / n;
  pooled.after = std::accumulate(after.begin(), after.end(), 0.0) / n;
  pooled.floor = floor;
  pooled.closed = closed([](std::size_t i) { return i; });
  if (!pooled.closed) return pooled;
  std::mt19937_64 random(seed);
  std::vector<double> closures;
  for (int k = 0; k < 400; ++k) {
    std::vector<std::size_t> drawn(before.size());
    for (std::size_t& index : drawn) index = random() % before.size();
    if (const auto closure = closed([&](std::size_t i) { return drawn[i]; })) closures.push_back(*closure);
  }
  if (closures.size() < 40) return pooled;
  std::sort(closures.begin(), closures.end());
  pooled.closed_ci = {closures[closures.size() / 40], closures[closures.size() - 1 - closures.size() / 40]};
  return pooled;
}

}  // namespace navcal::diagnosis

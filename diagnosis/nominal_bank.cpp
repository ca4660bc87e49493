// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/nominal_bank.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "diagnosis/limits.h"
#include "identify/data/actuator_inputs.h"
#include "identify/replay/predicted_readings.h"

namespace navcal::diagnosis {

using identify::kNuisances;
using identify::RecordedMotion;

double Floor::limit() const { return std::max(mean * kNominalFactor, mean + kNominalScatter_sigma * std); }

Floor floor_of(std::span<const double> of_recordings) {
  if (of_recordings.empty()) return {};
  const double n = static_cast<double>(of_recordings.size());
  const double mean = std::accumulate(of_recordings.begin(), of_recordings.end(), 0.0) / n;
  double square = 0;
  for (const double one : of_recordings) square += (one - mean) * (one - mean);
  return {mean, n > 1 ? std::sqrt(square / (n - 1)) : 0.1 * mean};
}

double misfit_of(const RecordingFit& fit, double log_evidence) {
  return -2 * log_evidence / std::max(fit.readings, 1.0);
}

void NominalBank::add(const RecordingFit& fit, const CauseLibrary& library, const ColumnPriors& priors) {
  const SetEvidence evidence(fit.linear, library, priors);
  Eigen::VectorXd estimate = Eigen::VectorXd::Zero(library.columns());
  for (std::size_t i = 0; i < library.causes.size(); ++i) {
    const auto posterior = evidence.posterior({i});
    for (const Eigen::Index column : library.causes[i].columns()) {
      // What the data say beyond chance.
      const double variance = posterior.std[column] * posterior.std[column];
      const double square = posterior.mean[column] * posterior.mean[column] - variance;
      estimate[column] = std::sqrt(std::max(square, 0.0));
    }
  }
  estimates.push_back(std::move(estimate));
  channel_powers.push_back(fit.channel_power);
  double square = 0;
  for (const double power : fit.window_power) square += power;
  powers.push_back(square / std::max(fit.readings, 1.0));
  misfits.push_back(misfit_of(fit, evidence({})));
}

std::vector<RecordedMotion> simulate_nominal(const config::Layout& layout, const CauseLibrary& library,
                                             const RecordedMotion& recording, const RecordingFit& fit,
                                             const ColumnPriors& priors, int count, std::uint64_t seed) {
  std::vector<RecordedMotion> simulated;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<identify::WindowReading> readings;
  for (std::size_t c = 0; c < identify::kChannels; ++c) {
    for (const identify::Reading& reading : recording.channels[c])
      readings.push_back({static_cast<identify::Channel>(c), reading.time_s, reading.value, reading.std});
  }
  const identify::ActuatorInputs inputs(layout, recording);
  const auto parameters = static_cast<Eigen::Index>(library.parameters.size());
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd draw(library.columns());
    for (Eigen::Index i = 0; i < draw.size(); ++i) draw[i] = priors.spike[i] * normal(random);
    Eigen::VectorXd values = draw.head(parameters);
    for (Eigen::Index i = 0; i < parameters; ++i) {
      const identify::Parameter& parameter = library.parameters[static_cast<std::size_t>(i)];
      const bool is_effect = static_cast<std::size_t>(i) >= library.layout_numbers;
      if (is_effect && parameter.low == 0) values[i] = std::abs(values[i]);
      values[i] = std::clamp(values[i] + parameter.prior, parameter.low, parameter.high);
    }
    const config::Layout drawn = identify::with_values(layout, library.parameters, values);
    const identify::Calibration calibration = draw.tail<kNuisances>();
    const auto steps = static_cast<std::size_t>(recording.duration_s / identify::ReplayedMotion::kStep_s);
    const auto motion =
        identify::replay(sim::LayoutVehicle(drawn), inputs.trajectory(drawn),
                         calibration[static_cast<Eigen::Index>(identify::Nuisance::actuator_delay)], 0, steps,
                         fit.states.front().front(), recording.tilt_lag_s);
    if (!motion) continue;
    std::vector<identify::WindowReading> inside = readings;
    const double end_s = identify::ReplayedMotion::kStep_s * static_cast<double>(steps);
    std::erase_if(inside, [&](const auto& reading) { return reading.time_s >= end_s; });
    RecordedMotion null = recording;
    for (auto& channel : null.channels) channel.clear();
    const Eigen::VectorXd predicted = identify::PredictedReadings(null)(*motion, inside, calibration);
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const double value = predicted[static_cast<Eigen::Index>(i)] + inside[i].std * normal(random);
      null.channels[static_cast<std::size_t>(inside[i].channel)].push_back(
          {inside[i].time_s, value, inside[i].std});
    }
    null.name = "simulated nominal recording";
    simulated.push_back(std::move(null));
  }
  return simulated;
}

ColumnPriors tolerances_of(const CauseLibrary& library, const identify::Calibration& nuisance_stds) {
  ColumnPriors priors{Eigen::VectorXd::Zero(library.columns()), Eigen::VectorXd::Zero(library.columns())};
  for (std::size_t i = 0; i < library.parameters.size(); ++i)
    priors.spike[static_cast<Eigen::Index>(i)] = library.parameters[i].prior_std;
  priors.spike.tail<kNuisances>() = nuisance_stds;
  for (const Cause& cause : library.causes) {
    for (const CauseParameter& parameter : cause.parameters)
      priors.typical[parameter.column] = parameter.typical * parameter.per_unit;
  }
  return priors;
}

ColumnPriors widened(ColumnPriors priors, const CauseLibrary& library, const NominalBank& bank) {
  if (bank.size() == 0) return priors;
  for (const Cause& cause : library.causes) {
    for (const CauseParameter& parameter : cause.parameters) {
      double square = 0;
      for (const Eigen::VectorXd& estimate : bank.estimates)
        square += estimate[parameter.column] * estimate[parameter.column];
      // Few recordings tell a scatter badly: one standard error of the mean square is added.
      const double n = static_cast<double>(bank.size());
      const double scatter = std::sqrt(square / n * (1 + std::sqrt(2 / n)));
      priors.spike[parameter.column] = std::max(priors.spike[parameter.column], scatter);
    }
  }
  return priors;
}

}  // namespace navcal::diagnosis

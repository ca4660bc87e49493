// SPDX-License-Identifier: Apache-2.0
#include "runs/nominal_vehicle.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/square.h"

namespace navcal::runs {
namespace {

constexpr std::size_t kFewestRuns = 5;
/// Fewer sessions tell little of how sessions differ.
constexpr std::size_t kSessionsWanted = 4;
/// Weights by which correlations are drawn to zero. A session's rest on as many degrees of freedom as there are
/// sessions less one, about as many as there are parameters: half. A run's rest on tens: a fifth.
constexpr double kSessionShrinkage = 0.5, kRunShrinkage = 0.2;
/// What is assumed of the parameters when only one session was seen: sessions differ by twice what runs do. The
/// spectrum scatters from run to run because it is short, which sessions have in common: its tolerance is enough.
constexpr double kSessionOverRun = 4;
/// Tolerance of the spectrum from session to session, dB, and the width over which such a deviation extends.
constexpr double kSpectrumTolerance_dB = 0.7, kSpectrumWidth_Hz = 0.25;
/// Share of the variance of a band that is its own alone, so that the covariance stays regular.
constexpr double kOwnShare = 0.1, kOwnVariance_dB2 = 0.05;

/// Rows a second: in all complete seconds of all runs.
double row_rate_of(std::span<const Run> runs) {
  double rows = 0, seconds = 0;
  for (const Run& run : runs) {
    const Eigen::VectorXd& clock = run.clock_s;
    Eigen::Index first = 0;
    while (first < clock.size() && clock[first] == clock[0]) ++first;
    Eigen::Index last = clock.size();
    while (last > first && clock[last - 1] == clock[clock.size() - 1]) --last;
    if (last <= first) continue;
    const double span_s = clock[clock.size() - 1] - clock[first];
    if (!(span_s >= 2)) continue;
    rows += static_cast<double>(last - first);
    seconds += span_s;
  }
  if (!(seconds > 0)) throw BadNominal("no nominal run shows the rate of its rows: time must advance in each");
  return rows / seconds;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The command with which runs begin.
double stop_command_of(std::span<const Run> runs) {
  std::vector<double> first;
  for (const Run& run : runs) first.push_back(run.command_us.row(0).mean());
  return median(std::move(first));
}

/// Level, slope and curvature over the bands, one column each.
Eigen::MatrixXd shape_of(Eigen::Index bands) {
  Eigen::MatrixXd shape(bands, 3);
  for (Eigen::Index band = 0; band < bands; ++band) {
    const double x = 2 * static_cast<double>(band) / static_cast<double>(bands - 1) - 1;
    shape.row(band) << 1, x, x * x - 1.0 / 3;
  }
  return shape;
}

struct NominalRuns {
  std::vector<std::string> names;
  std::vector<Response> responses;
  std::vector<std::vector<std::size_t>> sessions;
};

NominalRuns responses_of(std::span<const Run> runs, NominalVehicle& vehicle) {
  NominalRuns nominal;
  std::vector<RestState> rest;
  for (const Run& run : runs) {
    const Response response = response_of(run, vehicle.clock);
    if (!response.rest || !response.parameters.allFinite()) {
      vehicle.remarks.push_back(fmt::format(
          "nominal run {} is left out: it must begin at rest, run its thrusters, and last 8.5 s after that",
          run.name));
      continue;
    }
    nominal.names.push_back(run.name);
    nominal.responses.push_back(response);
    rest.push_back(*response.rest);
  }
  if (nominal.responses.size() < kFewestRuns) {
    throw BadNominal(
        fmt::format("{} nominal runs can be used; {} are needed", nominal.responses.size(), kFewestRuns));
  }
  nominal.sessions = sessions_of(rest);
  const bool enough =
      std::ranges::any_of(nominal.sessions, [](const auto& runs_of) { return runs_of.size() >= kRunsOfASession; });
  if (!enough) {
    throw BadNominal(
        fmt::format("no session of {} nominal runs is found: they must follow each other within half an "
                    "hour, with the same ballast",
                    kRunsOfASession));
  }
  return nominal;
}

Scatter parameters_of(const NominalRuns& nominal) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(nominal.responses.size()), Eigen::Index{kParameterCount});
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    values.row(i) = nominal.responses[static_cast<std::size_t>(i)].parameters.transpose();
  }
  Scatter scatter = scatter_of(values, nominal.sessions, kSessionOverRun);
  scatter.session = with_weaker_correlations(scatter.session, kSessionShrinkage);
  scatter.run = with_weaker_correlations(scatter.run, kRunShrinkage);
  for (Eigen::Index i = 0; i < kParameterCount; ++i) {
    const double tolerance = kParameters[static_cast<std::size_t>(i)].tolerance;
    scatter.session(i, i) += base::square(tolerance);
    scatter.run(i, i) += base::square(tolerance / 10);  // never singular
  }
  return scatter;
}

/// Mean of a diagonal of a covariance.
double at_lag(const Eigen::MatrixXd& covariance, Eigen::Index lag) { return covariance.diagonal(lag).mean(); }

/// The scatter of the spectrum is the same in each band, and correlated over neighbours only: so few runs do not
/// tell hundreds of covariances.
void make_stationary(Scatter& scatter) {
  const Eigen::Index bands = scatter.mean.size();
  const double session_dB2 = std::max(at_lag(scatter.session, 0), 0.0) + base::square(kSpectrumTolerance_dB);
  const double run_dB2[3] = {at_lag(scatter.run, 0), at_lag(scatter.run, 1), at_lag(scatter.run, 2)};
  for (Eigen::Index i = 0; i < bands; ++i) {
    for (Eigen::Index j = 0; j < bands; ++j) {
      const Eigen::Index lag = std::abs(i - j);
      const double apart = static_cast<double>(lag) * kBandWidth_Hz / kSpectrumWidth_Hz;
      scatter.session(i, j) = session_dB2 * std::exp(-0.5 * apart * apart);
      scatter.run(i, j) = lag < 3 ? run_dB2[lag] : 0;
    }
  }
  scatter.session.diagonal().array() += kOwnVariance_dB2;
  scatter.run.diagonal().array() += kOwnShare * run_dB2[0];
}

std::optional<Scatter> spectrum_of(const NominalRuns& nominal, const Eigen::MatrixXd& without_shape) {
  std::vector<std::vector<std::size_t>> sessions;
  for (const auto& session : nominal.sessions) {
    auto& kept = sessions.emplace_back();
    for (const std::size_t run : session) {
      if (nominal.responses[run].spectrum_dB) kept.push_back(run);
    }
  }
  if (std::ranges::none_of(sessions, [](const auto& session) { return session.size() >= kRunsOfASession; })) {
    return std::nullopt;
  }
  Eigen::MatrixXd values =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(nominal.responses.size()), without_shape.cols());
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const auto& spectrum_dB = nominal.responses[static_cast<std::size_t>(i)].spectrum_dB;
    if (spectrum_dB) values.row(i) = (without_shape * *spectrum_dB).transpose();
  }
  Scatter scatter = scatter_of(values, sessions, 0);
  make_stationary(scatter);
  return scatter;
}

}  // namespace

NominalVehicle identify(std::span<const Run> runs) {
  if (runs.size() < kFewestRuns) {
    throw BadNominal(fmt::format("{} nominal runs; {} are needed", runs.size(), kFewestRuns));
  }
  NominalVehicle vehicle;
  vehicle.thrusters = runs[0].command_us.cols();
  vehicle.clock = {row_rate_of(runs), stop_command_of(runs)};
  const NominalRuns nominal = responses_of(runs, vehicle);
  for (const auto& session : nominal.sessions) {
    auto& names = vehicle.sessions.emplace_back();
    for (const std::size_t run : session) names.push_back(nominal.names[run]);
  }
  vehicle.parameters = parameters_of(nominal);
  const Eigen::Index bands = bands_at(vehicle.clock.row_rate_Hz);
  if (bands > 3) {
    const Eigen::MatrixXd shape = shape_of(bands);
    vehicle.without_shape = Eigen::MatrixXd::Identity(bands, bands) -
                            shape * shape.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(bands, bands));
    vehicle.spectrum = spectrum_of(nominal, vehicle.without_shape);
  }
  if (!vehicle.spectrum) {
    vehicle.remarks.emplace_back("no spectrum of the yaw rate: runs too short, or rows too rare");
  }
  if (vehicle.parameters.sessions < kSessionsWanted) {
    vehicle.remarks.push_back(
        fmt::format("the nominal runs come from {} session{} of {} runs and more: how sessions differ is hardly "
                    "known, and probabilities are doubtful",
                    vehicle.parameters.sessions, vehicle.parameters.sessions == 1 ? "" : "s", kRunsOfASession));
  }
  return vehicle;
}

}  // namespace navcal::runs

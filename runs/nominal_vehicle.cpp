// SPDX-License-Identifier: Apache-2.0
#include "runs/nominal_vehicle.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/angles.h"
#include "base/square.h"
#include "base/statistics.h"

namespace navcal::runs {
namespace {

/// Within a session the ballast stays, so the attitude at rest repeats within half a degree, and the weather moves
/// the pressure by a few hectopascals.
constexpr double kRollScatter_rad = 0.4 * base::kRadiansPerDegree,
                 kPitchScatter_rad = 0.5 * base::kRadiansPerDegree;
constexpr double kPressureScatter = 4;
/// Largest distance, in those scatters, at which a run still belongs.
constexpr double kFarthest = 3;
/// A session pauses no longer, and no run begins while another still goes.
constexpr double kLongestPause_s = 1800, kShortestPause_s = 15;
/// Runs at the end of a session with which the next one is compared.
constexpr std::size_t kLatest = 4;

class Session {
 public:
  explicit Session(std::size_t first) : runs{first} {}

  /// Distance of a run from the session's latest ones; none when it cannot follow them.
  [[nodiscard]] std::optional<double> distance(const RestState& next, std::span<const RestState> all) const {
    const double pause_s = next.clock_s - all[runs.back()].clock_s;
    if (pause_s < kShortestPause_s || pause_s > kLongestPause_s) return std::nullopt;
    const std::size_t count = std::min(kLatest, runs.size());
    double roll_rad = 0, pitch_rad = 0, pressure = 0;
    for (std::size_t i = runs.size() - count; i < runs.size(); ++i) {
      roll_rad += all[runs[i]].roll_rad / static_cast<double>(count);
      pitch_rad += all[runs[i]].pitch_rad / static_cast<double>(count);
      pressure += all[runs[i]].surface_pressure / static_cast<double>(count);
    }
    return std::sqrt(base::square((next.roll_rad - roll_rad) / kRollScatter_rad) +
                     base::square((next.pitch_rad - pitch_rad) / kPitchScatter_rad) +
                     base::square((next.surface_pressure - pressure) / kPressureScatter));
  }

  std::vector<std::size_t> runs;
};

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

/// The command with which runs begin.
double stop_command_of(std::span<const Run> runs) {
  std::vector<double> first;
  for (const Run& run : runs) first.push_back(run.command_us.row(0).mean());
  return base::median(std::move(first));
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
        fmt::format("no session of {} nominal runs is found: they must follow each other within half an hour, "
                    "with the same ballast",
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

Scatter scatter_of(const Eigen::MatrixXd& values, std::span<const std::vector<std::size_t>> sessions,
                   double session_over_run) {
  const Eigen::Index n = values.cols();
  Scatter scatter;
  scatter.run.setZero(n, n);
  std::vector<Eigen::VectorXd> means;
  double degrees = 0, inverse_counts = 0;
  for (const auto& session : sessions) {
    if (session.size() < 2) continue;
    const Eigen::MatrixXd rows = values(session, Eigen::all);
    const Eigen::RowVectorXd mean = rows.colwise().mean();
    const Eigen::MatrixXd centred = rows.rowwise() - mean;
    scatter.run += centred.transpose() * centred;
    degrees += static_cast<double>(session.size() - 1);
    if (session.size() < kRunsOfASession) continue;
    means.emplace_back(mean.transpose());
    inverse_counts += 1 / static_cast<double>(session.size());
  }
  scatter.run /= degrees;
  scatter.sessions = means.size();
  const auto count = static_cast<double>(means.size());
  scatter.mean.setZero(n);
  for (const auto& mean : means) scatter.mean += mean / count;
  if (means.size() < 2) {
    scatter.session = session_over_run * scatter.run.diagonal().asDiagonal();
    return scatter;
  }
  scatter.session.setZero(n, n);
  for (const auto& mean : means) {
    scatter.session += (mean - scatter.mean) * (mean - scatter.mean).transpose() / (count - 1);
  }
  // The scatter of the means contains that of the runs; what is left keeps the correlations of the means.
  const Eigen::VectorXd whole = scatter.session.diagonal();
  const Eigen::VectorXd left =
      (whole - scatter.run.diagonal() * inverse_counts / count).cwiseMax(0) * (1 + 1 / count);
  const Eigen::VectorXd factor = (left.array() / whole.array().max(1e-300)).sqrt().matrix();
  scatter.session = factor.asDiagonal() * scatter.session * factor.asDiagonal();
  return scatter;
}

Eigen::MatrixXd with_weaker_correlations(const Eigen::MatrixXd& covariance, double weight) {
  Eigen::MatrixXd weaker = (1 - weight) * covariance;
  weaker.diagonal() = covariance.diagonal();
  return weaker;
}

std::vector<std::vector<std::size_t>> sessions_of(std::span<const RestState> rest) {
  std::vector<std::size_t> order(rest.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rest[i].clock_s; });
  std::vector<Session> sessions;
  for (const std::size_t run : order) {
    Session* nearest = nullptr;
    double least = kFarthest;
    for (Session& session : sessions) {
      const auto distance = session.distance(rest[run], rest);
      if (!distance || *distance >= least) continue;
      least = *distance;
      nearest = &session;
    }
    if (nearest != nullptr) {
      nearest->runs.push_back(run);
    } else {
      sessions.emplace_back(run);
    }
  }
  std::vector<std::vector<std::size_t>> lists;
  for (Session& session : sessions) lists.push_back(std::move(session.runs));
  return lists;
}

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

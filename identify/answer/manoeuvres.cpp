// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/manoeuvres.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>

#include "autopilot/allocation.h"
#include "base/statistics.h"
#include "identify/answer/directions.h"
#include "identify/data/actuator_inputs.h"
#include "identify/replay/predicted_readings.h"

namespace navcal::identify {
namespace {

constexpr double kOrderEvery_s = 0.1, kPointEvery_s = 0.01;

/// Of two signals of a shaft the first is its position, the last its command.
void note(RecordedMotion& motion, const config::Layout& layout, double time_s, const sim::ActuatorValues& values,
          bool are_positions) {
  const auto put = [&](const std::vector<std::string>& names, double value) {
    if (names.empty()) return;
    Signal& signal = motion.signals[are_positions ? names.front() : names.back()];
    signal.times_s.push_back(time_s);
    signal.values.push_back(value);
  };
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i)
    put(signals_of_thruster(layout, i), values.thrusters[i]);
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i)
    put(signals_of_surface(layout, i), values.surfaces_rad[i]);
  for (std::size_t i = 0; i < layout.ballasts.size(); ++i)
    if (!layout.ballasts[i].channel.empty()) put({layout.ballasts[i].channel}, values.ballasts_N[i]);
  for (std::size_t i = 0; i < layout.moving_masses.size(); ++i)
    if (!layout.moving_masses[i].channel.empty()) put({layout.moving_masses[i].channel}, values.masses_m[i]);
}

constexpr double kSeconds = 40;
constexpr double kWorth = 0.9;  ///< standard error after over before

/// Wanted shares of the greatest force and moment, in turn, each for `leg_s`.
struct ManoeuvreRow {
  const char* name;
  double leg_s;
  std::vector<std::array<double, 6>> shares;
};

const std::vector<ManoeuvreRow>& table_of_manoeuvres() {
  static const std::vector<ManoeuvreRow> kTable{
      {"speed steps straight ahead", 5, {{0.3}, {0.9}, {0.5}, {0.7}}},
      {"coasting down from full speed", 10, {{0.9}, {0}}},
      {"doublets of yaw at half speed", 2, {{0.5, 0, 0, 0, 0, 0.5}, {0.5, 0, 0, 0, 0, -0.5}}},
      {"circles at half speed", 20, {{0.5, 0, 0, 0, 0, 0.5}, {0.5, 0, 0, 0, 0, -0.5}}},
      {"turns on the spot both ways", 4, {{0, 0, 0, 0, 0, 0.5}, {0, 0, 0, 0, 0, -0.5}}},
      {"doublets of pitch at half speed", 2, {{0.5, 0, 0, 0, 0.3, 0}, {0.5, 0, 0, 0, -0.3, 0}}},
      {"doublets of roll", 1, {{0, 0, 0, 0.3, 0, 0}, {0, 0, 0, -0.3, 0, 0}}},
      {"moving sideways both ways", 4, {{0, 0.5}, {0, -0.5}}},
      {"rising and sinking by thrust", 4, {{0, 0, 0.4}, {0, 0, -0.4}}},
      {"drifting with everything off", 40, {{0}}},
  };
  return kTable;
}

/// Commands of a manoeuvre, or none where the actuators cannot follow it.
std::function<sim::ActuatorValues(double, const sim::Body&)> commands_of(const config::Layout& layout,
                                                                         const ManoeuvreRow& row) {
  const auto allocator = std::make_shared<autopilot::Allocator>(layout);
  return [allocator, &row](double time_s, const sim::Body& body) {
    const config::Layout& of = allocator->layout();
    const auto leg = static_cast<std::size_t>(time_s / row.leg_s) % row.shares.size();
    const auto limits = allocator->limits(body.velocity);
    const Eigen::MatrixXd matrix = allocator->matrix(body.velocity);
    autopilot::AllocationRequest request;
    request.velocity = body.velocity;
    request.saturation = autopilot::Saturation::least_squares;
    const Eigen::VectorXd both_ways = limits.high.cwiseMax(-limits.low);
    for (Eigen::Index i = 0; i < 6; ++i) {
      request.wanted[i] =
          row.shares[leg][static_cast<std::size_t>(i)] * matrix.row(i).cwiseAbs().dot(both_ways.transpose());
    }
    const auto allocated = allocator->allocate(request);
    sim::ActuatorValues values = sim::ActuatorValues::neutral(of);
    const bool is_off = std::ranges::all_of(row.shares[leg], [](double x) { return x == 0; });
    if (is_off) return values;
    values.thrusters = allocated.thruster_commands;
    values.surfaces_rad = allocated.surfaces_rad;
    return values;
  };
}

/// Information of a recording about the parameters, without nuisances.
Eigen::MatrixXd information_of(const PredictionErrorProblem& problem) {
  const auto point = problem.at(problem.start());
  if (point.passes.empty()) throw std::invalid_argument("the vehicle leaves all bounds");
  Eigen::MatrixXd all = problem.linearise(point, PredictionErrorProblem::Parameters::free).information;
  const auto n = std::ssize(problem.parameters()), rest = all.rows() - n;
  all.diagonal().tail(rest) += problem.precision().tail(rest);
  const Eigen::MatrixXd own =
      all.topLeftCorner(n, n) -
      all.topRightCorner(n, rest) * Eigen::LDLT<Eigen::MatrixXd>(all.bottomRightCorner(rest, rest))
                                        .solve(Eigen::MatrixXd(all.bottomLeftCorner(rest, n)));
  return (own + own.transpose()) / 2;
}

std::optional<ManoeuvreAdvice> advice_of(const ManoeuvreRow& row, const PredictionErrorProblem& problem,
                                         const Estimate& estimate, const EstimateSettings& settings,
                                         const config::Layout& fitted) {
  const RecordedMotion& like = problem.filters().front().recording();
  SimulatedMotionRequest request;
  request.channels = channels_of(like);
  request.seconds = kSeconds;
  request.start.position_m.z() = 5;
  request.commands = commands_of(fitted, row);
  request.tilt_lag_s = like.tilt_lag_s;
  request.dip_rad = like.dip_rad;
  const std::vector<RecordedMotion> recordings{simulated_motion(fitted, request)};
  if (recordings.front().duration_s < kSeconds / 2) return std::nullopt;
  // The same unknowns about the estimate: only the prior's mean is another.
  std::vector<Parameter> parameters = problem.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    parameters[i].prior = estimate.unknowns[static_cast<Eigen::Index>(i)];
  PredictionErrorProblem simulated(fitted, parameters, recordings, settings);
  simulated.set_noises(problem.noises());
  const Eigen::MatrixXd information = information_of(simulated) / estimate.model_error;
  const Eigen::Index n = information.rows();
  // C' = C - C (H^-1 + C)^-1 C without an inverse of H: C' = (1 + C H)^-1 C.
  const Eigen::MatrixXd grown = Eigen::MatrixXd::Identity(n, n) + estimate.covariance * information;
  const Eigen::PartialPivLU<Eigen::MatrixXd> factor(grown);
  const Eigen::MatrixXd after = factor.solve(estimate.covariance);
  ManoeuvreAdvice advice{row.name, kSeconds, 0.5 * std::log(std::abs(factor.determinant())), {}, 0, 0};
  double best = kWorth;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Parameter& parameter = parameters[static_cast<std::size_t>(i)];
    if (estimate.stds[i] <= kTold * parameter.prior_std) continue;
    const double std_after = std::sqrt(std::max(after(i, i), 0.0));
    if (std_after >= best * estimate.stds[i]) continue;
    best = std_after / estimate.stds[i];
    advice.parameter = parameter.name;
    advice.std_before = estimate.stds[i];
    advice.std_after = std_after;
  }
  return advice.parameter.empty() ? std::nullopt : std::optional(advice);
}

}  // namespace

std::vector<ChannelNoise> channels_of(const RecordedMotion& motion) {
  std::vector<ChannelNoise> all;
  for (std::size_t c = 0; c < kChannels; ++c) {
    const auto& readings = motion.channels[c];
    if (readings.size() < 2) continue;
    const double span_s = readings.back().time_s - readings.front().time_s;
    if (!(span_s > 0)) continue;
    std::vector<double> stds;
    for (const Reading& reading : readings) stds.push_back(reading.std);
    all.push_back({static_cast<Channel>(c), static_cast<double>(readings.size() - 1) / span_s,
                   base::median(std::move(stds))});
  }
  return all;
}

RecordedMotion simulated_motion(const config::Layout& layout, const SimulatedMotionRequest& request) {
  const sim::LayoutVehicle vehicle(layout);
  RecordedMotion recorded;
  recorded.name = "simulated";
  recorded.duration_s = request.seconds;
  recorded.fins_are_reported = request.reports_positions;
  std::vector<MotionPoint> points;
  sim::Body body = request.start;
  sim::ActuatorValues positions = sim::ActuatorValues::neutral(layout), commands = positions;
  const double step_s = ActuatorTrajectory::kStep_s;
  const auto per_point = static_cast<long>(std::lround(kPointEvery_s / step_s));
  const auto per_order = static_cast<long>(std::lround(kOrderEvery_s / step_s));
  for (long k = 0; k <= std::lround(request.seconds / step_s); ++k) {
    const double time_s = step_s * static_cast<double>(k);
    if (k % per_order == 0) {
      commands = request.commands(time_s, body);
      if (!request.reports_positions) note(recorded, layout, time_s, commands, false);
    }
    if (request.reports_positions) note(recorded, layout, time_s, positions, true);
    sim::ActuatorValues next = sim::follow(layout, positions, commands, step_s);
    const sim::Vector6 disturbance = request.disturbance ? request.disturbance(time_s) : sim::Vector6::Zero();
    auto step = vehicle.step(body, sim::mean_of(positions, next), step_s);
    if (k % per_point == 0) {
      const sim::LayoutVehicle::Held now = vehicle.hold(positions);
      MotionPoint point;
      point.body = body;
      point.acceleration =
          now.mass_inverse * vehicle.force(body.velocity, sim::down_of(body.euler_rad), now) + disturbance;
      point.tilt_rad = body.euler_rad.head<2>();
      if (!points.empty())
        point.tilt_rad = lagged_tilt(points.back().tilt_rad, points.back().body.euler_rad.head<2>(),
                                     point.tilt_rad, request.tilt_lag_s, kPointEvery_s);
      points.push_back(point);
    }
    step.body.velocity += step_s * disturbance;
    const bool is_sane = std::abs(step.body.euler_rad.y()) < 1.5 && step.body.velocity.cwiseAbs().maxCoeff() < 30;
    if (!is_sane) {
      recorded.duration_s = time_s;
      break;
    }
    body = step.body;
    positions = std::move(next);
  }
  recorded.tilt_lag_s = request.tilt_lag_s;
  recorded.dip_rad = request.dip_rad;
  const PredictedReadings instruments(recorded);
  const Eigen::Vector3d current = current_of(request.calibration);
  std::mt19937_64 random(request.seed.value_or(0));
  std::normal_distribution<double> normal;
  for (const ChannelNoise& channel : request.channels) {
    for (double due_s = 0.5 / channel.rate_Hz;; due_s += 1 / channel.rate_Hz) {
      const auto at = static_cast<std::size_t>(std::lround(due_s / kPointEvery_s));
      if (at >= points.size()) break;
      const double time_s = kPointEvery_s * static_cast<double>(at);
      ChannelReading reading{channel.channel, time_s, 0, channel.std};
      instruments.at(points[at], time_s * current, std::span(&reading, 1), request.calibration, &reading.value);
      if (request.seed) reading.value += channel.std * normal(random);
      recorded.channels[static_cast<std::size_t>(channel.channel)].push_back({time_s, reading.value, channel.std});
    }
  }
  return recorded;
}

std::vector<ManoeuvreAdvice> advised_manoeuvres(const PredictionErrorProblem& problem, const Estimate& estimate,
                                                const EstimateSettings& settings, const FitProgress& progress) {
  const config::Layout fitted =
      with_values(problem.layout(), problem.parameters(), estimate.unknowns.head(estimate.stds.size()));
  std::vector<ManoeuvreAdvice> all;
  const auto& table = table_of_manoeuvres();
  for (std::size_t i = 0; i < table.size(); ++i) {
    progress("manoeuvres", static_cast<double>(i) / static_cast<double>(table.size()));
    try {
      if (auto advice = advice_of(table[i], problem, estimate, settings, fitted))
        all.push_back(std::move(*advice));
    } catch (const std::invalid_argument&) {
      // This vehicle cannot do it: its motion leaves all bounds, or nothing is left to measure.
    }
  }
  std::ranges::sort(
      all, [](const auto& a, const auto& b) { return a.std_after / a.std_before < b.std_after / b.std_before; });
  return all;
}

}  // namespace navcal::identify

// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/manoeuvres.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "autopilot/allocation.h"
#include "identify/answer/directions.h"
#include "identify/answer/simulated_motion.h"

namespace navcal::identify {
namespace {

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
    const bool is_off =
        std::all_of(row.shares[leg].begin(), row.shares[leg].end(), [](double x) { return x == 0; });
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
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.std_after / a.std_before < b.std_after / b.std_before; });
  return all;
}

}  // namespace navcal::identify

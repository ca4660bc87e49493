// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/order_times.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "base/parallel.h"
#include "gap/actuators/fin_orders.h"
#include "gap/inference/biases.h"
#include "gap/inference/linearised.h"

namespace navcal::gap {
namespace {

constexpr std::size_t kPhases = 10;
constexpr double kPhase_s = kInterval_s / static_cast<double>(kPhases);

/// Length of the part of a mission that is evaluated, where the fins move most. It determines the phase as well
/// as the whole does.
constexpr double kLooked_at_s = 200;
/// Standard deviation of the priors, typical values: of effects, and of the gyros' biases, which are new at
/// each power-on.
constexpr double kFree = 0.1, kBiasesFree = 10;

template <class Reading>
std::vector<Reading> within(const std::vector<Reading>& readings, double from_s, double until_s) {
  std::vector<Reading> kept;
  std::ranges::copy_if(readings, std::back_inserter(kept), [&](const Reading& reading) {
    return reading.time_s >= from_s && reading.time_s < until_s;
  });
  return kept;
}

/// Begin of the stretch of so many seconds in which the fins move most.
double busiest_from_s(const std::vector<MotorReading>& readings, double seconds) {
  double moved = 0, most = 0, from_s = 0;
  std::size_t first = 1;
  const auto move = [&](std::size_t i) {
    double sum = 0;
    for (std::size_t fin = 0; fin < 3; ++fin)
      sum += std::abs(readings[i].fins_rad[fin] - readings[i - 1].fins_rad[fin]);
    return sum;
  };
  for (std::size_t i = 1; i < readings.size(); ++i) {
    moved += move(i);
    for (; readings[i].time_s - readings[first].time_s > seconds; ++first) moved -= move(first);
    if (moved <= most) continue;
    most = moved;
    from_s = readings[first].time_s;
  }
  return from_s;
}

Mission busiest_part(const Mission& mission) {
  const double from_s = busiest_from_s(mission.motor, kLooked_at_s);
  const double until_s = std::min(from_s + kLooked_at_s, mission.duration_s);
  Mission part;
  part.compass = within(mission.compass, from_s, until_s);
  part.card = within(mission.card, from_s, until_s);
  part.fixes = within(mission.fixes, from_s, until_s);
  part.motor = within(mission.motor, from_s, until_s);
  part.duration_s = until_s;
  part.field = mission.field;
  part.instruments = mission.instruments;
  part.silences = mission.silences;
  part.judged_from_s = mission.judged_from_s;
  part.judged_until_s = mission.judged_until_s;
  return part;
}

Mission ordered_at(const Mission& mission, double phase_s) {
  Mission ordered = mission;
  ordered.order_times_s = regular_orders(phase_s, mission.duration_s);
  ordered.ordered_fins_rad.clear();
  return ordered;
}

}  // namespace

std::vector<double> likely_order_times_s(const Mission& mission, const config::VehicleSettings& vehicle,
                                         const Library& library, unsigned threads) {
  const Whitening whitening = Whitening::nominal(mission.instruments);
  const Mission part = busiest_part(mission);
  // An instrument may be silent in that part.
  const bool is_whole =
      !part.card.empty() && (!part.compass.empty() || mission.compass.empty()) && !part.motor.empty();
  const Mission& looked_at = is_whole && part.shortcoming().empty() ? part : mission;
  const Mission first = ordered_at(looked_at, 0);
  const Replay replay(first, vehicle);
  const Eigen::VectorXd at = with_biases_found(replay, library, threads);
  // The phase must not compensate a gap, so all effects of the library are free. They are free only a little:
  // otherwise lags would compensate a wrong phase.
  const Linearised linear = linearise({replay, library, whitening, threads}, at);
  Eigen::VectorXd widths(at.size());
  for (Eigen::Index j = 0; j < widths.size(); ++j) {
    widths[j] =
        (j < Library::kBiases ? kBiasesFree : kFree) * library.unknowns()[static_cast<std::size_t>(j)].typical;
  }
  const Eigen::MatrixXd gram = widths.asDiagonal() * linear.gram * widths.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> free(gram + Eigen::MatrixXd::Identity(gram.rows(), gram.cols()));

  std::array<double, kPhases> cost{};
  base::in_parallel(threads, cost.size(), [&](std::size_t i) {
    const Mission ordered = ordered_at(looked_at, kPhase_s * static_cast<double>(i));
    const Eigen::VectorXd residual = residual_at({Replay(ordered, vehicle), library, whitening}, at);
    const Eigen::VectorXd score = widths.cwiseProduct(linear.design.transpose() * residual);
    cost[i] = residual.squaredNorm() - score.dot(free.solve(score));
  });
  // The phase between those evaluated, by the parabola through the best and its neighbours.
  const auto best = static_cast<std::size_t>(std::ranges::min_element(cost) - cost.begin());
  const double before = cost[(best + kPhases - 1) % kPhases], after = cost[(best + 1) % kPhases];
  const double bend = before - 2 * cost[best] + after;
  const double shift = bend > 0 ? (before - after) / (2 * bend) : 0;
  const double phase_s = kPhase_s * (static_cast<double>(best) + shift);
  return regular_orders(std::fmod(phase_s + kInterval_s, kInterval_s), mission.duration_s);
}

}  // namespace navcal::gap

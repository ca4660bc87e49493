#include "gap/order_times.h"

#include <algorithm>
#include <array>

#include "gap/biases.h"
#include "gap/fin_orders.h"
#include "gap/linearised.h"
#include "gap/parallel.h"

namespace navcal::gap {
namespace {

constexpr int kPhases = 10;
constexpr double kPhase_s = kInterval_s / kPhases;

Mission ordered_at(const Mission& mission, double phase_s) {
  Mission ordered = mission;
  ordered.order_times_s = regular_orders(phase_s, mission.duration_s);
  return ordered;
}

}  // namespace

std::vector<double> likely_order_times_s(const Mission& mission, const config::VehicleSettings& vehicle,
                                         const Library& library, unsigned threads) {
  const Whitening whitening = Whitening::nominal();
  const Mission first = ordered_at(mission, 0);
  const Replay replay(first, vehicle);
  const Eigen::VectorXd at = with_biases_found(replay, library, threads);
  std::array<double, kPhases> cost{};
  in_parallel(threads, cost.size(), [&](std::size_t i) {
    const Mission ordered = ordered_at(mission, kPhase_s * static_cast<double>(i));
    cost[i] = residual_at(Replay(ordered, vehicle), library, whitening, at).squaredNorm();
  });
  const auto best = std::min_element(cost.begin(), cost.end()) - cost.begin();
  return regular_orders(kPhase_s * static_cast<double>(best), mission.duration_s);
}

}  // namespace navcal::gap

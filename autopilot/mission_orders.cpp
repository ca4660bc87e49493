// SPDX-License-Identifier: Apache-2.0
#include "autopilot/mission_orders.h"

#include <numbers>
#include <utility>

#include "base/rounding.h"

namespace navcal::autopilot {
namespace {

/// The motor card takes tenths of a degree (its interface document, section 4).
constexpr double kOrdered_rad = 0.1 * std::numbers::pi / 180;

}  // namespace

MissionOrders::MissionOrders(const config::VehicleSettings& vehicle, config::Mission mission)
    : steps_(std::move(mission)), autopilot_(vehicle) {
  orders_.shaft_rps = steps_.mission().start.shaft_rps;
}

const Orders& MissionOrders::next(const VehicleState& state, double period_s) {
  orders_ = autopilot_.orders(steps_.next(state, period_s, orders_), state, period_s);
  for (double& fin : orders_.fins_rad) fin = base::rounded(fin, kOrdered_rad);
  return orders_;
}

}  // namespace navcal::autopilot

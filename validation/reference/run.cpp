// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "validation/reference/card.h"
#include "validation/reference/compass.h"
#include "validation/reference/helmsman.h"
#include "validation/reference/motor.h"
#include "validation/reference/outbox.h"
#include "validation/reference/receiver.h"

namespace navcal::reference {
namespace {

void check(const Mission& mission) {
  if (!std::isfinite(mission.duration_s) || mission.duration_s < 0)
    throw std::invalid_argument("a mission lasts a finite time, not less than none");
  double last_s = 0;
  for (const Order& order : mission.orders) {
    for (const double number :
         {order.from_s, order.heading_rad.value_or(0), order.rudder_rad, order.depth_m.value_or(0),
          order.elevator_rad, order.speed_m_s.value_or(0), order.shaft_rev_s}) {
      if (!std::isfinite(number)) throw std::invalid_argument("an order is not a finite number");
    }
    if (order.from_s < last_s) throw std::invalid_argument("orders are not in order of time");
    last_s = order.from_s;
  }
}

}  // namespace

std::optional<Lost> run(const Mission& mission, const VehicleUnderTest& specimen, std::uint64_t seed, Sink& sink) {
  check(mission);
  const ParameterDeviations& deviations = specimen.deviations;
  const Fitting fitting{seed, specimen.noisy, mission.start_ns, specimen.clock_ppm, specimen.host_delay_s};
  const auto with_clock = [&](double slow) {
    Fitting its_own = fitting;
    its_own.clock_slow = slow;
    return its_own;
  };
  const Waters& waters = mission.waters;
  Hull hull = specimen.hull;
  hull.water_density_kg_m3 = waters.density_kg_m3;
  World world(Vehicle(hull, deviations.vehicle, mission.start),
              std::max(deviations.card.latency_s, deviations.gps.latency_s) + 1, waters.surface_C);
  Compass compass(with_clock(specimen.clocks.compass), deviations.compass, waters.field_uT);
  Card card(with_clock(specimen.clocks.card), deviations.card);
  Receiver receiver(fitting, deviations.gps, mission.anchorage);
  Motor motor(with_clock(specimen.clocks.motor));
  Helmsman helmsman(std::atan2(waters.field_uT.y(), waters.field_uT.x()));
  Outbox outbox(sink);
  std::size_t following = 0;  // order

  const auto ticks = static_cast<std::int64_t>(std::floor(mission.duration_s / Helmsman::kPeriod_s + 1e-9));
  for (std::int64_t tick = 0; tick < ticks; ++tick) {
    const Snapshot now = world.now();
    sink.truth(now);
    const double time_s = static_cast<double>(tick) * Helmsman::kPeriod_s;
    while (following < mission.orders.size() && mission.orders[following].from_s <= time_s + 1e-9) ++following;
    if (following > 0) {
      const Controls controls = helmsman.steer(mission.orders[following - 1], compass.reading(), card.reading());
      motor.order(controls.shaft_rev_s, controls.fins_rad, world, outbox.waiting());
    }
    world.advance(time_s + Helmsman::kPeriod_s);
    if (!world.vehicle().finite()) return Lost{time_s, now};
    for (Instrument* instrument : {static_cast<Instrument*>(&compass), static_cast<Instrument*>(&card),
                                   static_cast<Instrument*>(&receiver), static_cast<Instrument*>(&motor)}) {
      instrument->catch_up(world, outbox.waiting());
    }
    outbox.hand_over(mission.start_ns + std::llround(world.now().time_s * 1e9));
  }
  sink.truth(world.now());
  outbox.hand_over(std::numeric_limits<std::int64_t>::max());
  return std::nullopt;
}

}  // namespace navcal::reference

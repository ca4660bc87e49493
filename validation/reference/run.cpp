// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "protocols/motor_card.h"
#include "validation/reference/card.h"
#include "validation/reference/compass.h"
#include "validation/reference/receiver.h"

namespace navcal::reference {

World::World(Vehicle vehicle, double memory_s, double surface_C)
    : History(vehicle.snapshot(), Vehicle::kStep_s, memory_s, surface_C), vehicle_(std::move(vehicle)) {}

void World::advance(double to_s) {
  const double begin_s = vehicle_.time_s();
  const auto steps = std::llround((to_s - begin_s) / Vehicle::kStep_s);
  for (long long i = 1; i <= steps; ++i) {
    vehicle_.advance(begin_s + static_cast<double>(i) * Vehicle::kStep_s);
    remember(vehicle_.snapshot());
  }
}

namespace {

namespace motor_wire = protocols::motor_card;
constexpr double kMotorPeriod_s = 0.1, kMotorLatency_s = 0.005;
constexpr double kFinNoise_deg = 0.1, kCurrentNoise_A = 0.02;

/// Motor card (ICD section 4): shaft speed, angles of the servos' shafts, current; 10 Hz, 5 ms from measurement to
/// the first byte. It takes the helmsman's orders as they can be written: whole rpm, tenths of a degree.
class Motor final : public Instrument {
 public:
  explicit Motor(const Fitting& fitting)
      : Instrument(fitting, Port::motor, kMotorPeriod_s, kMotorLatency_s), start_ns_(fitting.start_ns),
        sequence_(static_cast<std::uint8_t>(dice().bits())) {}

  /// Writes the order to the card, when it is a new one, and sets servos and shaft going.
  void order(double shaft_rev_s, const Vector3& fins_rad, World& world, std::vector<Transfer>& out) {
    const int rpm = static_cast<int>(std::lround(60 * shaft_rev_s));
    Eigen::Vector3i tenths_deg;
    for (int i = 0; i < 3; ++i) {
      const double tenths = std::round(fins_rad(i) / kDegree * 10);
      tenths_deg(i) =
          static_cast<int>(std::clamp(tenths, -10 * motor_wire::kFinLimit_deg, 10 * motor_wire::kFinLimit_deg));
    }
    if (rpm == rpm_ && tenths_deg == tenths_deg_) return;
    rpm_ = rpm;
    tenths_deg_ = tenths_deg;
    world.vehicle().command(rpm_ / 60.0, tenths_deg_.cast<double>() * (0.1 * kDegree));
    const motor_wire::Command command{rpm_, {tenths_deg(0) / 10.0, tenths_deg(1) / 10.0, tenths_deg(2) / 10.0}};
    out.push_back({Port::motor, true, start_ns_ + std::llround(world.now().time_s * 1e9),
                   motor_wire::encode_command(command)});
  }

 private:
  std::vector<std::uint8_t> sample(const History& history, double time_s) override {
    const Snapshot s = history.at(time_s);
    motor_wire::Status status;
    status.sequence = sequence_++;
    status.rpm_commanded = rpm_;
    status.rpm = static_cast<std::int32_t>(std::lround(60 * s.shaft_rev_s));
    for (int i = 0; i < 3; ++i)
      status.fins_deg[static_cast<std::size_t>(i)] = s.servos_rad(i) / kDegree + noise(kFinNoise_deg);
    status.current_A = s.motor_current_A + noise(kCurrentNoise_A);
    return motor_wire::encode_status(status);
  }

  std::int64_t start_ns_;
  int rpm_ = 0;
  Eigen::Vector3i tenths_deg_ = Eigen::Vector3i::Zero();
  std::uint8_t sequence_;
};

/// Commands of the helmsman.
struct Controls {
  double shaft_rev_s = 0;
  Vector3 fins_rad = Vector3::Zero();
};

/// The vehicle's own autopilot, ten times a second. It knows nothing but what the instruments say, as a vehicle's
/// does, so that their errors steer it:
///     rudder = 0.35 e + 0.02 int(e) - 0.3 r                     e: heading wanted less heading
///     pitch wanted = -(0.3 d + 0.02 int(d)), within 25 degrees    d: depth wanted less depth
///     elevator = 0.8 (pitch wanted - pitch) - 0.4 q             both within 15 degrees
class Helmsman {
 public:
  /// `variation_rad`: of magnetic north from true north where it steers, as its charts have it.
  explicit Helmsman(double variation_rad) : variation_rad_(variation_rad) {}

  static constexpr double kPeriod_s = 0.1;

  [[nodiscard]] Controls steer(const Order& order, const Compass::Reading& compass, const Card::Reading& card);

 private:
  double variation_rad_;
  double heading_sum_ = 0, depth_sum_ = 0;  ///< integrals of what was missed
};

constexpr double kFinRange_rad = 15 * kDegree, kPitchRange_rad = 25 * kDegree;
constexpr double kMetresPerTurn = 0.0872;  ///< of the shaft, at a steady speed
/// Integrals are for small errors that stay: a turn or a dive must not wind them up.
constexpr double kNear_rad = 0.2, kNear_m = 0.4;

void gather(double& sum, double missed, double near) {
  if (std::abs(missed) < near) sum += missed * Helmsman::kPeriod_s;
}

Controls Helmsman::steer(const Order& order, const Compass::Reading& compass, const Card::Reading& card) {
  double rudder = order.rudder_rad, elevator = order.elevator_rad;
  if (order.heading_rad) {
    const double missed =
        std::remainder(*order.heading_rad - compass.heading_rad - variation_rad_, 2 * std::numbers::pi);
    gather(heading_sum_, missed, kNear_rad);
    rudder =
        std::clamp(0.35 * missed + 0.02 * heading_sum_ - 0.3 * card.yaw_rate_rad_s, -kFinRange_rad, kFinRange_rad);
  }
  if (order.depth_m) {
    const double missed = *order.depth_m - card.depth_m;
    gather(depth_sum_, missed, kNear_m);
    const double pitch = std::clamp(-(0.3 * missed + 0.02 * depth_sum_), -kPitchRange_rad, kPitchRange_rad);
    elevator =
        std::clamp(0.8 * (pitch - compass.pitch_rad) - 0.4 * card.pitch_rate_rad_s, -kFinRange_rad, kFinRange_rad);
  }
  const double shaft_rev_s = order.speed_m_s ? *order.speed_m_s / kMetresPerTurn : order.shaft_rev_s;
  return {shaft_rev_s, FinLinkage::mixed(rudder, elevator) + order.fins_beside_rad};
}

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
  const Waters& waters = mission.waters;
  Hull hull = specimen.hull;
  hull.water_density_kg_m3 = waters.density_kg_m3;
  World world(Vehicle(hull, deviations.vehicle, mission.start),
              std::max(deviations.card.latency_s, deviations.gps.latency_s) + 1, waters.surface_C);
  Compass compass(fitting.with_clock(specimen.clocks.compass), deviations.compass, waters.field_uT);
  Card card(fitting.with_clock(specimen.clocks.card), deviations.card);
  Receiver receiver(fitting, deviations.gps, mission.anchorage);
  Motor motor(fitting.with_clock(specimen.clocks.motor));
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
    for (Instrument* instrument : std::initializer_list<Instrument*>{&compass, &card, &receiver, &motor})
      instrument->catch_up(world, outbox.waiting());
    outbox.hand_over(mission.start_ns + std::llround(world.now().time_s * 1e9));
  }
  sink.truth(world.now());
  outbox.hand_over(std::numeric_limits<std::int64_t>::max());
  return std::nullopt;
}

}  // namespace navcal::reference

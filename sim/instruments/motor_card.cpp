// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/motor_card.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/rounding.h"
#include "sim/vehicle/motor_current.h"

namespace navcal::sim {
namespace {

namespace motor = protocols::motor_card;

}  // namespace

MotorCard::MotorCard(const Options& options, const Motion& motion)
    : CommandedDevice(options.baud), options_(options), motion_(motion),
      effects_(options.effects != nullptr ? *options.effects : none_), noise_(options.seed) {}

void MotorCard::power_on(std::int64_t t_ns) {
  ticks_ = Ticks(t_ns, 1 / options_.motor.timing.rate_Hz, options_.clock_ppm);
  forget();
  command_.reset();
  if (options_.obey) options_.obey(t_ns, {});
  sequence_ = 0;
}

void MotorCard::obey(std::int64_t t_ns, const protocols::Frame& command) {
  if (command.id != motor::kMcc) return;
  const auto wanted = motor::decode_command(command.bytes);
  if (!wanted) return;
  const auto beyond = [](double fin) { return std::abs(fin) > motor::kFinLimit_deg; };
  if (std::ranges::any_of(wanted->fins_deg, beyond)) {
    ++refused_;
    return;
  }
  at_command_ = actuators_at(t_ns);
  commanded_ns_ = t_ns;
  command_ = wanted;
  if (options_.obey) options_.obey(t_ns, *wanted);
}

void MotorCard::act(std::int64_t now_ns, std::vector<Emission>& out) {
  send(now_ns, motor::encode_status(measure(now_ns - std::llround(options_.motor.timing.latency_s * 1e9))), out);
  ticks_.pass(effects_.slow_ppm(Instrument::motor, effects_.time_s(now_ns)));
}

MotorCard::Actuators MotorCard::actuators_at(std::int64_t t_ns) const {
  if (!command_ || options_.obey) {
    const State state = motion_.at(t_ns);
    Actuators now{state.rpm, {}, state.motor_current_A};
    for (std::size_t i = 0; i < 3; ++i) now.fins_deg[i] = state.fins_rad[i] * base::kDegreesPerRadian;
    return now;
  }
  const double since_s = std::max(0.0, static_cast<double>(t_ns - commanded_ns_) * 1e-9);
  const auto follow = [&](double from, double to, double lag_s) {
    return to + (from - to) * std::exp(-since_s / lag_s);
  };
  Actuators now;
  now.rpm = follow(at_command_.rpm, command_->rpm, options_.propeller.lag_s);
  for (std::size_t i = 0; i < 3; ++i) {
    now.fins_deg[i] = follow(at_command_.fins_deg[i], command_->fins_deg[i], options_.fins.lag_s);
  }
  now.current_A = current_A(options_.propeller, now.rpm / 60);
  return now;
}

motor::Status MotorCard::measure(std::int64_t t_ns) {
  const Actuators now = actuators_at(t_ns);
  const double louder = effects_.noise(Instrument::motor, effects_.time_s(t_ns));
  const double fin_noise_deg = options_.motor.fin_noise_rad * base::kDegreesPerRadian;
  motor::Status status;
  status.sequence = sequence_++;
  status.rpm_commanded = command_ && !options_.obey
                             ? command_->rpm
                             : static_cast<std::int32_t>(std::lround(motion_.at(t_ns).rpm_commanded));
  status.rpm = static_cast<std::int32_t>(std::lround(now.rpm));
  for (std::size_t i = 0; i < 3; ++i) {
    const double noise_deg = noise_.normal(fin_noise_deg * louder);
    status.fins_deg[i] = base::rounded(now.fins_deg[i] + noise_deg, options_.motor.fin_resolution_deg);
  }
  const double current_A = now.current_A + noise_.normal(options_.motor.current_noise_A * louder);
  status.current_A = base::rounded(std::max(0.0, current_A), options_.motor.current_resolution_A);
  return status;
}

}  // namespace navcal::sim

// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/battery_gauge.h"

#include <algorithm>
#include <string>

#include "protocols/nmea_vehicle.h"

namespace navcal::sim {

Battery::Battery(const Options& options)
    : options_(options), charge_Ah_(std::clamp(options.charge_Ah, 0.0, options.capacity_Ah)) {}

void Battery::draw(double motor_A, double duration_s) {
  constexpr double kSecondsPerHour = 3600;
  charge_Ah_ =
      std::clamp(charge_Ah_ - current_A(motor_A) * duration_s / kSecondsPerHour, 0.0, options_.capacity_Ah);
}

double Battery::open_circuit_V() const {
  const double place = charge_Ah_ / options_.capacity_Ah * static_cast<double>(options_.curve_V.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), options_.curve_V.size() - 2);
  return std::lerp(options_.curve_V[below], options_.curve_V[below + 1], place - static_cast<double>(below));
}

double Battery::voltage_V(double motor_A) const {
  return open_circuit_V() - options_.resistance_ohm * current_A(motor_A);
}

BatteryGauge::BatteryGauge(const Options& options, const Motion& motion)
    : LineDevice(options.baud), options_(options), motion_(motion), battery_(options.battery),
      noise_(options.seed) {}

void BatteryGauge::power_on(std::int64_t t_ns) {
  constexpr double kPeriod_s = 0.5;
  ticks_ = Ticks(t_ns, kPeriod_s, 0);
  drawn_ns_ = t_ns;
}

void BatteryGauge::act(std::int64_t now_ns, std::vector<Emission>& out) {
  const double motor_A = motion_.at(now_ns).motor_current_A;
  battery_.draw(motor_A, static_cast<double>(now_ns - drawn_ns_) * 1e-9);
  drawn_ns_ = now_ns;
  const double voltage_V = battery_.voltage_V(motor_A) + noise_.normal(options_.voltage_noise_V);
  const double current_A = battery_.current_A(motor_A) + noise_.normal(options_.current_noise_A);
  const std::array gauges{protocols::nmea::StatedTransducer{'U', std::max(0.0, voltage_V), 3, 'V', "BATTERY"},
                          protocols::nmea::StatedTransducer{'I', current_A, 3, 'A', "BATTERY"}};
  std::string sentence;
  protocols::nmea::append_xdr(sentence, gauges);
  send(now_ns, {sentence.begin(), sentence.end()}, out);
  ticks_.pass();
}

}  // namespace navcal::sim

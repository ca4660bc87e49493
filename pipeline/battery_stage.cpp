// SPDX-License-Identifier: Apache-2.0
#include "pipeline/battery_stage.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>

namespace navcal::pipeline {
namespace {

/// A battery that is low is so until its charge has risen by so much of the capacity.
constexpr double kLowHysteresis = 0.05;
/// A load that comes and goes pulls the voltage down for less than this.
constexpr std::int64_t kLowVoltage_ns = 5'000'000'000;
/// Voltage above the limit at which the alarm is cleared.
constexpr double kLowVoltageHysteresis_V = 0.5;

}  // namespace

std::unique_ptr<BatteryStage> BatteryStage::make(const config::Settings& settings) {
  if (!settings.battery.enabled) return nullptr;
  return std::make_unique<BatteryStage>(settings.battery);
}

BatteryStage::BatteryStage(const config::BatterySettings& settings)
    : settings_(settings), interval_ns_(std::llround(settings.interval_s * 1e9)), estimator_(settings) {}

void BatteryStage::take(const instruments::Sample& sample, const std::optional<NavigationSample>& navigation,
                        const UtcMapping& mapping, Sink& sink) {
  feed(sample);
  if (!port_) return;
  if (navigation && navigation->estimate.speed_m_s)
    estimator_.speed(sample.stamp.arrival_ns, *navigation->estimate.speed_m_s);
  judge(sample, sink);
  tell(sample, mapping, sink);
}

/// Counted by arrivals: they never decrease over all ports, and the latencies of the instruments are of no weight.
void BatteryStage::feed(const instruments::Sample& sample) {
  const std::int64_t now_ns = sample.stamp.arrival_ns;
  if (const auto* gauge = std::get_if<instruments::PowerSample>(&sample.value)) {
    if (has_gauge_ && port_ != sample.port) return;  // one pack, one gauge: the first
    has_gauge_ = true;
    port_ = sample.port;
    estimator_.gauge(now_ns, gauge->current_A, gauge->voltage_V);
  } else if (const auto* motor = std::get_if<instruments::MotorSample>(&sample.value)) {
    if (!motor->current_A) return;
    if (!port_) port_ = sample.port;
    estimator_.motor_current(now_ns, *motor->current_A);
  } else {
    estimator_.advance(now_ns);
  }
}

void BatteryStage::judge(const instruments::Sample& sample, Sink& sink) {
  const std::int64_t now_ns = sample.stamp.arrival_ns;
  const auto charge = estimator_.charge();
  const auto voltage_V = estimator_.voltage_V();
  const double low_Ah = (settings_.low + (low_ ? kLowHysteresis : 0)) * settings_.capacity_Ah;
  const double low_V = settings_.low_V + (low_ ? kLowVoltageHysteresis_V : 0);
  if (settings_.low_V <= 0 || !voltage_V || *voltage_V >= low_V) {
    below_since_ns_.reset();
  } else if (!below_since_ns_) {
    below_since_ns_ = now_ns;
  }
  const bool by_charge = charge && charge->charge_Ah < low_Ah;
  const bool by_voltage = below_since_ns_ && (low_ || now_ns - *below_since_ns_ >= kLowVoltage_ns);
  if ((by_charge || by_voltage) == low_) return;
  low_ = !low_;
  if (low_) low_port_ = *port_;
  std::string words;
  if (charge) words = fmt::format("{:.2f} of {:g} Ah left", charge->charge_Ah, settings_.capacity_Ah);
  if (voltage_V) words += fmt::format("{}{:.1f} V", words.empty() ? "" : ", ", *voltage_V);
  sink.on_alarm({EstimateAlarm::battery_low, low_, low_port_, now_ns, words});
}

void BatteryStage::tell(const instruments::Sample& trigger, const UtcMapping& mapping, Sink& sink) {
  const std::int64_t now_ns = trigger.stamp.arrival_ns;
  const std::int64_t interval = now_ns / interval_ns_;
  if (newest_ && interval <= told_) return;
  told_ = interval;
  BatterySample sample;
  sample.port = *port_;
  sample.stamp.arrival_ns = sample.stamp.validity_ns = now_ns;
  sample.stamp.arrival_utc_ns = sample.stamp.validity_utc_ns = mapping.to_utc(now_ns);
  sample.voltage_V = estimator_.voltage_V();
  sample.current_A = estimator_.current_A();
  sample.current_is_measured = estimator_.current_is_measured();
  sample.charge = estimator_.charge();
  sample.capacity_Ah = settings_.capacity_Ah;
  sample.nominal_V = settings_.nominal_V;
  sample.time_left_s = estimator_.time_left_s();
  sample.range_left_m = estimator_.range_left_m();
  sample.low = low_;
  newest_ = sample;
  sink.on_battery(sample);
}

}  // namespace navcal::pipeline

// SPDX-License-Identifier: Apache-2.0
#include "emulation/simulate_history.h"

#include <variant>

namespace navcal::emulation {
namespace {

constexpr double kMost = 4000;

/// Nothing but the conversion is wanted.
config::Settings settings_for(const std::vector<config::PortSettings>& ports) {
  config::Settings settings;
  settings.ports = ports;
  settings.calibration.enabled = false;
  return settings;
}

}  // namespace

SimulateHistory::SimulateHistory(const std::vector<config::PortSettings>& ports, std::int64_t begin_ns,
                                 double duration_s)
    : pipeline_(settings_for(ports)), begin_ns_(begin_ns), apart_s_(duration_s / kMost) {}

void SimulateHistory::add(double time_s, const sim::State& state) { keep(series_.states, time_s, state); }

void SimulateHistory::add(const sim::LineRead& read) {
  if (!read.sent) pipeline_.bytes(static_cast<std::uint16_t>(read.of), read.time_ns, read.bytes, *this);
}

template <class Value>
void SimulateHistory::keep(std::vector<Timed<Value>>& list, double time_s, const Value& value) {
  if (list.empty() || time_s >= list.back().time_s + apart_s_) list.push_back({time_s, value});
}

void SimulateHistory::on_sample(const instruments::Sample& sample) {
  const double time_s = static_cast<double>(sample.stamp.validity_ns - begin_ns_) * 1e-9;
  if (const auto* word = std::get_if<instruments::CompassSample>(&sample.value))
    keep(series_.compass, time_s, *word);
  if (const auto* record = std::get_if<instruments::ImuSample>(&sample.value)) keep(series_.imu, time_s, *record);
  if (const auto* fix = std::get_if<instruments::GpsSample>(&sample.value)) keep(series_.gps, time_s, *fix);
  if (const auto* status = std::get_if<instruments::MotorSample>(&sample.value))
    keep(series_.motor, time_s, *status);
}

}  // namespace navcal::emulation

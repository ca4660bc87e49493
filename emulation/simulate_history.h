// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "config/settings.h"
#include "pipeline/pipeline.h"
#include "sim/instruments/host_line.h"
#include "sim/state.h"

namespace navcal::emulation {

/// A value with its time in seconds since the beginning.
template <class Value>
struct Timed {
  double time_s = 0;
  Value value;
};

/// The truth, and what each instrument said.
struct SimulatedSeries {
  std::vector<Timed<sim::State>> states;
  std::vector<Timed<instruments::CompassSample>> compass;
  std::vector<Timed<instruments::ImuSample>> imu;
  std::vector<Timed<instruments::GpsSample>> gps;
  std::vector<Timed<instruments::MotorSample>> motor;
};

/// Data for the plots of a simulation: the truth, and each instrument's output as a daemon decodes it from the
/// bytes. Some thousands of each, for any length of the mission.
class SimulateHistory final : public pipeline::Sink {
 public:
  /// The first port is the compass's, then come card, receiver and motor card.
  SimulateHistory(const std::vector<config::PortSettings>& ports, std::int64_t begin_ns, double duration_s);

  void add(double time_s, const sim::State& state);
  void add(const sim::LineRead& read);
  void on_sample(const instruments::Sample& sample) override;

  [[nodiscard]] const SimulatedSeries& series() const { return series_; }

 private:
  template <class Value>
  void keep(std::vector<Timed<Value>>& list, double time_s, const Value& value);

  pipeline::Pipeline pipeline_;
  SimulatedSeries series_;
  std::int64_t begin_ns_;
  double apart_s_;  ///< between what is kept
};

}  // namespace navcal::emulation

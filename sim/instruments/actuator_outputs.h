// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "config/described/outputs_port.h"
#include "protocols/nmea.h"
#include "sim/instruments/device.h"
#include "sim/state.h"

namespace navcal::sim {

/// Greatest number of outputs that the lines have.
inline constexpr std::size_t kMostOutputs = 16;

/// Controller of the actuators of a layout: says ten times a second what each was told, config::kOutputsLatency_s
/// later.
class ActuatorOutputs final : public Device {
 public:
  /// A vehicle that obeys: called with the outputs of each line that comes (of kMostOutputs; nullopt where the
  /// line has none), and with 1500 us on all when power comes.
  using Obey = std::function<void(std::int64_t t_ns, const std::vector<std::optional<double>>& pulses_us)>;
  explicit ActuatorOutputs(const Motion& motion, Obey obey = {}) : motion_(motion), obey_(std::move(obey)) {}

  void power_on(std::int64_t t_ns) override;
  void on_bytes(std::int64_t t_ns, protocols::Bytes bytes) override;
  [[nodiscard]] std::int64_t next_event_ns() const override { return next_ns_; }
  void advance(std::int64_t t_ns, std::vector<Emission>& out) override;
  [[nodiscard]] int baud() const override { return config::kOutputsBaud; }

 private:
  const Motion& motion_;
  Obey obey_;
  Line line_;
  protocols::nmea::Parser parser_;
  std::vector<OutputOrder> orders_;
  std::int64_t next_ns_ = kNever_ns;
};

}  // namespace navcal::sim

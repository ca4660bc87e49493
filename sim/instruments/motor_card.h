// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "config/vehicle.h"
#include "devices/instrument_model.h"
#include "protocols/motor_card.h"
#include "sim/effects/effect_set.h"
#include "sim/instruments/device.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

/// Motor controller card. Until the host commands it, it tells what the vehicle does; from then on its shaft and
/// fins follow the command with the nominal vehicle's lags (docs/simulator.md). When there is a vehicle that
/// obeys, the card always tells what that vehicle does.
class MotorCard final : public CommandedDevice<protocols::motor_card::Parser> {
 public:
  using Obey = std::function<void(std::int64_t t_ns, const protocols::motor_card::Command&)>;
  struct Options {
    devices::MotorModel motor;
    double clock_ppm = 0;
    config::PropellerSettings propeller;  ///< of the vehicle that obeys commands, with its fins
    config::FinSettings fins;
    std::uint64_t seed = 1;
    int baud = 19200;
    EffectSet* effects = nullptr;  ///< nullptr: nominal
    /// A vehicle that obeys: called with each command that is not refused, and with shaft off and fins neutral
    /// when power comes.
    Obey obey{};
  };
  MotorCard(const Options& options, const Motion& motion);

  void power_on(std::int64_t t_ns) override;

  /// Last command of the host that was not refused; nullopt from power-on to the first.
  [[nodiscard]] const std::optional<protocols::motor_card::Command>& command() const { return command_; }
  /// Commands refused because a fin was beyond its limit.
  [[nodiscard]] std::uint64_t refused() const { return refused_; }

 private:
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  void obey(std::int64_t t_ns, const protocols::Frame& command) override;
  struct Actuators {
    double rpm = 0;
    std::array<double, 3> fins_deg{};
    double current_A = 0;
  };
  /// Shaft speed, fin angles and current at t_ns.
  [[nodiscard]] Actuators actuators_at(std::int64_t t_ns) const;
  [[nodiscard]] protocols::motor_card::Status measure(std::int64_t t_ns);

  Options options_;
  const Motion& motion_;
  EffectSet none_;
  EffectSet& effects_;
  Noise noise_;
  std::optional<protocols::motor_card::Command> command_;
  Actuators at_command_;  ///< their positions when the command came
  std::int64_t commanded_ns_ = 0;
  std::uint64_t refused_ = 0;
  std::uint8_t sequence_ = 0;
};

}  // namespace navcal::sim

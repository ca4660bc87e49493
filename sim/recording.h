// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "config/settings.h"
#include "devices/instrument_model.h"
#include "sim/geodesy.h"
#include "sim/instruments/clock_factor.h"
#include "sim/instruments/host_line.h"
#include "sim/state.h"

namespace navcal::sim {

/// What the commands to the vehicle are recorded from, at the place of Instrument::motor.
enum class CommandPort : std::uint8_t {
  motor_card,  ///< of one propeller and three fins
  outputs,     ///< of the actuators of a layout: instruments/actuator_outputs.h
};

/// The ports of a recording by these instruments, in the order of Instrument.
[[nodiscard]] std::vector<config::PortSettings> recording_ports(const devices::InstrumentModel& instruments,
                                                                CommandPort commands = CommandPort::motor_card);

/// The four instruments from power-on, each on its line, as a host records them. Nothing has to be said to them:
/// the compass is set up to send all it has, and the receiver is asked for its position every second in the first
/// moment. The motor card is told what the vehicle's helm orders; the outputs of a layout say it themselves.
class Recording {
 public:
  struct Options {
    std::int64_t begin_ns = 0;  ///< power comes, UTC
    bool noise = true;          ///< of the instruments and the host; resolution and latency stay
    std::uint64_t seed = 1;
    EffectSet* effects = nullptr;       ///< nullptr: nominal; must outlive the recording
    bool turn_on_bias = true;           ///< of the gyros
    bool sky_always_seen = false;       ///< fixes at every depth, from the first second on
    std::vector<ClockFactor> clocks{};  ///< of compass, imu and motor
    Origin origin{};                    ///< origin of the fixes
    CommandPort commands = CommandPort::motor_card;
    devices::InstrumentModel instruments{};
  };
  Recording(const Options& options, const Motion& motion);

  /// The reads that returned up to t_ns (UTC), and the writes, appended in order of time; t_ns never goes back.
  void advance(std::int64_t t_ns, std::vector<LineRead>& out);

 private:
  struct Channel {
    std::unique_ptr<Device> device;
    HostLine line;
  };
  void ask_receiver(std::int64_t t_ns);
  void write_orders(std::int64_t t_ns);

  EffectSet none_;
  EffectSet& effects_;
  const Motion& motion_;
  std::vector<Channel> channels_;
  std::vector<Emission> emissions_;
  std::vector<Order> orders_;
  std::vector<LineRead> sent_;
};

}  // namespace navcal::sim

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocols/keller.h"
#include "protocols/paroscientific.h"
#include "sim/instruments/device.h"
#include "sim/state.h"

namespace navcal::sim {

struct PressureOptions {
  double noise_Pa = 20;
  double clock_ppm = 0;
  std::uint64_t seed = 1;
  int baud = 9600;
};

/// Absolute pressure at the vehicle's origin, without errors: a standard atmosphere above sea water of 1025 kg/m3.
[[nodiscard]] double absolute_pressure_Pa(const State& state);

struct ParoscientificOptions : PressureOptions {
  int unit = 1;  ///< UN
  double integration_s = 2.0 / 3;
};

/// Paroscientific gauge as it is delivered: silent until it is asked. UN, VR, P3 and P4 are obeyed. Any command
/// ends the continuous values of P4.
class ParoscientificEmulator final
    : public MeasuringDevice<ParoscientificOptions, CommandedDevice<protocols::paroscientific::Parser>> {
 public:
  using MeasuringDevice::MeasuringDevice;

  void power_on(std::int64_t t_ns) override;

 private:
  [[nodiscard]] std::int64_t next_act_ns() const override;
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  void obey(std::int64_t t_ns, const protocols::Frame& command) override;
  [[nodiscard]] std::string value(std::int64_t t_ns);

  bool continuous_ = false;            ///< P4
  std::optional<std::int64_t> p3_ns_;  ///< when the answer to P3 is due
};

struct KellerOptions : PressureOptions {
  std::uint8_t address = 1;
  bool echoes = false;  ///< the host's converter returns what the host says
};

/// Keller transmitter as it is delivered: it answers F48 and F73 at its own address and at 250, and refuses F73
/// before F48.
class KellerEmulator final : public MeasuringDevice<KellerOptions, CommandedDevice<protocols::keller::Parser>> {
 public:
  using MeasuringDevice::MeasuringDevice;

  void power_on(std::int64_t t_ns) override;

 private:
  [[nodiscard]] std::int64_t next_act_ns() const override { return kNever_ns; }
  void act(std::int64_t, std::vector<Emission>&) override {}
  void obey(std::int64_t t_ns, const protocols::Frame& command) override;
  [[nodiscard]] Message reply_to(std::int64_t t_ns, const protocols::Frame& request);

  bool initialised_ = false, was_initialised_ = false;
};

}  // namespace navcal::sim

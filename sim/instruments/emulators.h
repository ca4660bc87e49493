// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "protocols/frame.h"
#include "sim/geodesy.h"
#include "sim/instruments/altimeter.h"
#include "sim/instruments/device.h"
#include "sim/state.h"

namespace navcal::sim {

/// Options that every emulated device takes.
struct EmulatorOptions {
  int baud = 0;            ///< 0: that of its row in protocols/device_types.h
  std::uint64_t seed = 1;  ///< of its noise and biases
  double clock_ppm = 0;    ///< positive: its seconds are too long; receivers follow UTC
  Origin origin{};         ///< position of the motion's (0, 0, 0)
  SeaFloor floor{};        ///< below Doppler logs
};

/// Not so for a described device, of which only its file knows what it measures, and for an autopilot.
[[nodiscard]] bool has_emulator(protocols::Protocol protocol);

/// A device that speaks `protocol`, as it is delivered. `motion` must outlive it.
[[nodiscard]] std::unique_ptr<Device> make_emulator(protocols::Protocol protocol, const EmulatorOptions& options,
                                                    const Motion& motion);

}  // namespace navcal::sim

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "devices/instrument_model.h"
#include "protocols/trax.h"
#include "sim/instruments/device.h"
#include "sim/instruments/electronics.h"
#include "sim/state.h"

namespace navcal::sim {

struct PniOptions {
  devices::CompassModel compass;
  double force_noise_m_s2 = base::reference::kForceNoise_m_s2;
  double clock_ppm = 0;
  std::uint64_t seed = 1;
  int baud = 38400;
  bool has_continuous = true;
};

/// PNI TRAX (ICD section 11): data on request and continuous, settings, and the user calibration with automatic
/// sampling. Made from the documentation in use here, not from a device. After power-on it waits to be polled.
/// Noise is that of the reference compass; the tilt has no lag, because it comes from accelerometers.
class PniUnit final : public MeasuringDevice<PniOptions, CommandedDevice<protocols::trax::Parser>> {
 public:
  using MeasuringDevice::MeasuringDevice;

  void power_on(std::int64_t t_ns) override;

 private:
  static constexpr std::int64_t kThinks_ns = 2'000'000;

  [[nodiscard]] std::int64_t next_act_ns() const override;
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  void obey(std::int64_t t_ns, const protocols::Frame& command) override;
  struct Sample {
    double heading_rad, pitch_rad, roll_rad;
  };
  void obey_setting(std::int64_t t_ns, protocols::Bytes payload);
  void start_calibration(std::int64_t t_ns);
  void take_calibration_sample(std::int64_t t_ns);
  void say(std::int64_t t_ns, std::vector<std::uint8_t> bytes) { answer(t_ns + kThinks_ns, std::move(bytes)); }
  [[nodiscard]] std::vector<std::uint8_t> data(std::int64_t t_ns);

  Electronics electronics_;
  std::vector<std::uint8_t> components_;
  bool continuous_ = false, polled_ = true;
  double interval_s_ = 0.1;
  bool calibrating_ = false, automatic_ = true;
  std::uint32_t points_ = 12;
  std::vector<Sample> samples_;
  std::int64_t next_look_ns_ = 0;  ///< of the automatic sampling
};

}  // namespace navcal::sim

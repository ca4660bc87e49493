// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "devices/instrument_model.h"
#include "protocols/vectornav_lines.h"
#include "sim/instruments/device.h"
#include "sim/instruments/electronics.h"
#include "sim/state.h"

namespace navcal::sim {

struct VectorNavOptions {
  devices::Timing timing = devices::usual_timing(protocols::Protocol::vectornav, 115200);
  int port = 1;            ///< of its two serial ports that at which its host is
  bool has_errors = true;  ///< the attitude group has the standard deviations: not in old firmware
  bool is_bare = false;    ///< without binary output
  double clock_ppm = 0;    ///< positive: its seconds are too long
  double rate_noise_rad_s = 7e-4;
  double force_noise_m_s2 = 0.02;
  double field_noise_uT = 0.2;
  double heading_noise_rad = 0.02;
  double tilt_noise_rad = 0.005;
  std::uint64_t seed = 1;
  int baud = 115200;
};

/// VectorNav VN-100 (ICD section 12). As delivered it sends lines VNYMR at 40 Hz; its registers are written by its
/// host and forgotten with its power. Noise is white and that of its data sheet at this rate; the errors of its
/// attitude are those that it states. Yaw is magnetic.
class VectorNav final : public MeasuringDevice<VectorNavOptions, CommandedDevice<protocols::vectornav::Parser>> {
 public:
  using MeasuringDevice::MeasuringDevice;

  void power_on(std::int64_t t_ns) override;

 private:
  [[nodiscard]] std::int64_t next_act_ns() const override;
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  void obey(std::int64_t t_ns, const protocols::Frame& command) override;
  [[nodiscard]] std::string value_of(unsigned number) const;
  /// 0 when it was carried out, else the code of the error.
  std::uint8_t set(std::int64_t t_ns, const protocols::vectornav::Register& wanted);
  std::uint8_t set_output(std::int64_t t_ns, const std::string& values);
  void restart_ticks(std::int64_t t_ns, double rate_Hz);
  [[nodiscard]] protocols::vectornav::Reading measure(std::int64_t sent_ns);

  Electronics electronics_;
  std::int64_t powered_ns_ = 0;
  int line_type_ = 14, line_rate_Hz_ = 40;
  std::string output_ = "0,0,00";  ///< of register 75
  bool sends_binary_ = false, sends_errors_ = false;
};

}  // namespace navcal::sim

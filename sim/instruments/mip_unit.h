// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "devices/instrument_model.h"
#include "protocols/mip.h"
#include "protocols/mip_commands.h"
#include "sim/instruments/device.h"
#include "sim/state.h"

namespace navcal::sim {

struct MipOptions {
  devices::ImuModel imu;
  devices::CompassModel compass;
  double clock_ppm = 0;  ///< positive: its seconds are too long
  std::uint64_t seed = 1;
  int baud = 115200;
  bool newer_commands = true;     ///< those that name the data set
  bool has_complementary = true;  ///< attitude in the sensor data
  bool has_filter = true;
};

/// MicroStrain inertial sensor (ICD section 7): sensor data, filter data with true headings, reference time of its
/// own clock, and the commands of the start-up dialogue. After power-on it streams nothing until it is configured.
/// Noise and turn-on bias are those of the reference card and compass.
class MipUnit final : public MeasuringDevice<MipOptions, CommandedDevice<protocols::mip::Parser>> {
 public:
  using MeasuringDevice::MeasuringDevice;

  void power_on(std::int64_t t_ns) override;

 private:
  struct Stream {
    std::uint8_t set = 0;
    std::vector<std::uint8_t> fields;
    std::int64_t decimation = 0;  ///< base ticks; 0: no format
    bool on = false;
    std::int64_t next_tick = 0;
  };
  [[nodiscard]] std::int64_t next_act_ns() const override;
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  void obey(std::int64_t t_ns, const protocols::Frame& command) override;
  /// Error of the reply.
  std::uint8_t obey_base(std::int64_t t_ns, std::uint8_t command);
  std::uint8_t obey_3dm(std::int64_t t_ns, std::uint8_t command, protocols::Bytes data);
  std::uint8_t set_format(std::int64_t t_ns, std::uint8_t set, protocols::Bytes list);
  std::uint8_t set_stream(std::int64_t t_ns, std::uint8_t selector, bool on);
  void begin_stream(Stream& stream, std::int64_t t_ns) const;
  [[nodiscard]] bool knows(std::uint8_t set, std::uint8_t descriptor) const;
  [[nodiscard]] Stream* stream_of(std::uint8_t set);
  [[nodiscard]] std::int64_t time_of(std::int64_t tick) const;
  [[nodiscard]] const Stream* first_due() const;
  [[nodiscard]] std::int64_t sent_ns(const Stream& stream) const;
  [[nodiscard]] std::vector<std::uint8_t> packet(const Stream& stream);
  void put_sensor(const std::vector<std::uint8_t>& fields, const State& state, protocols::mip::Packet& packet);
  void put_filter(const std::vector<std::uint8_t>& fields, const State& state, protocols::mip::Packet& packet);

  std::array<Stream, 2> streams_;
  Vector3 bias_rad_s_{};
  bool idle_ = false;
  std::int64_t powered_ns_ = 0;
};

}  // namespace navcal::sim

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>

#include "protocols/tcm2_commands.h"
#include "protocols/tcm2_reply.h"
#include "sim/instruments/device.h"
#include "sim/instruments/tcm2_sensor.h"

namespace navcal::sim {

/// The TCM2's own calibration as far as the host can see it: how well the turns and tilts made so far cover what
/// it needs (ICD section 1). The emulated unit has no iron to correct, so the magnitude is that of its noise.
class Tcm2Score {
 public:
  void clear() { *this = {}; }
  void add(const Tcm2Reading& reading);
  [[nodiscard]] protocols::tcm2::CalibrationScore score() const;

 private:
  static constexpr std::size_t kSectors = 36;
  std::bitset<kSectors> headings_;
  double least_pitch_rad_ = 0, greatest_pitch_rad_ = 0;
  double least_roll_rad_ = 0, greatest_roll_rad_ = 0;
};

/// TCM2 compass: words, command dialogue and built-in calibration of ICD section 1. At power-on it says its banner
/// and waits for `go`; settings are those of the factory (all fields off but heading, pitch, roll, temperature),
/// which a warm restart keeps and a loss of power does not. The line speed is kept through both.
class Tcm2 final : public CommandedDevice<protocols::tcm2::CommandParser> {
 public:
  struct Options {
    Tcm2Sensor::Options sensor;      ///< with the words' latency and rate
    int baud = 38400;                ///< from the factory 9600; the vehicle's is set to 38400
    bool go_at_power_on = false;     ///< words from the beginning, as a unit so configured
    bool field_at_power_on = false;  ///< with the magnetometers' readings in them
    double clock_ppm = 0;
    std::uint64_t seed = 1;
  };
  Tcm2(const Options& options, const Motion& motion);

  void power_on(std::int64_t t_ns) override;

 private:
  struct Settings {
    bool heading = true, pitch = true, roll = true, field = false, temperature = true;
    bool heading_in_mils = false, tilt_in_mils = false, fahrenheit = false, nmea = false;
    int divider = 1;
    double clock_Hz = 0;
  };
  [[nodiscard]] std::int64_t next_act_ns() const override;
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  void obey(std::int64_t t_ns, const protocols::Frame& command) override;
  void obey(std::int64_t t_ns, const protocols::tcm2::Command& command);
  /// Empty when accepted, else the error of the refusal.
  std::uint32_t set(const protocols::tcm2::Command& command);
  void start(std::int64_t t_ns);
  void restart(std::int64_t t_ns);
  void answer_with(std::int64_t t_ns, const protocols::tcm2::Reply& reply);
  void answer_word(std::int64_t t_ns, const Settings& fields);
  [[nodiscard]] std::vector<std::uint8_t> word(std::int64_t t_ns, const Settings& fields);
  [[nodiscard]] double period_s() const;
  [[nodiscard]] std::int64_t latency_ns() const;

  Options options_;
  EffectSet none_;
  EffectSet& effects_;
  Tcm2Sensor sensor_;
  Tcm2Score score_;
  Settings settings_;
  bool running_ = false;
  bool calibrating_ = false;
  int next_baud_;  ///< takes effect after a restart
  std::int64_t measured_ns_ = 0;
};

}  // namespace navcal::sim

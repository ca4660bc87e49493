// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/instrument_model.h"
#include "emulation/emulate_port.h"
#include "emulation/place_arguments.h"
#include "record/whole_file.h"
#include "sim/effects/effect_set.h"
#include "sim/instruments/actuator_outputs.h"
#include "sim/instruments/clock_factor.h"
#include "sim/instruments/imu_card.h"
#include "sim/instruments/motor_card.h"
#include "sim/instruments/oncore.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::emulation {

/// The true motion of the emulated vehicle, 100 rows a second (sim/path.h). The file appears when it is finished.
class EmulateTruth {
 public:
  /// Time 0 is `start_ns` (UTC). Throws std::system_error.
  EmulateTruth(const std::filesystem::path& file, const sim::Motion& motion, std::int64_t start_ns);

  /// Writes the rows up to `now_ns`, which never goes back. Throws sim::UnstableVehicle, std::system_error.
  void advance(std::int64_t now_ns);
  /// Gives the file its name, with the rows up to the last advance(), or to where that threw. Throws
  /// std::system_error.
  void finish();

 private:
  record::WholeFile file_;
  const sim::Motion& motion_;
  std::int64_t start_ns_, next_ns_;
  std::string rows_;
};

/// An emulated device beside those of the vehicle, or in the place of the one at that port.
struct EmulatedDevice {
  std::string port;
  protocols::Protocol protocol = protocols::Protocol::nmea;
};

/// "gps=nmea": a port name of letters, digits, `-` and `_`, and a protocol. nullopt when it is not such a text.
[[nodiscard]] std::optional<EmulatedDevice> parse_emulated_device(std::string_view text);

struct EmulateArguments {
  std::filesystem::path dir;
  std::filesystem::path path;        ///< empty, and no mission: the path that comes with it
  std::string mission;               ///< name of a shipped one, or a file
  bool ordered = false;              ///< the vehicle obeys the motor card; no path, no mission
  std::filesystem::path vehicle;     ///< of the orders or the mission; empty: the reference vehicle
  std::filesystem::path truth;       ///< of the motion; empty: none
  std::vector<std::string> effects;  ///< NAME=STRENGTH
  std::filesystem::path effects_file;
  bool no_noise = false;
  std::filesystem::path config;          ///< of the instruments; empty: the reference instruments
  devices::InstrumentModel instruments;  ///< line speeds stay those of the vehicle's ports
  std::filesystem::path sent_log;
  double seconds = 0;  ///< 0: until it is stopped
  std::uint64_t seed = 1;
  std::optional<double> imu_ppm;
  std::vector<sim::ClockFactor> clocks;
  PlaceArguments where;
  int compass_baud = 38400;
  sim::Oncore::Kind gps = sim::Oncore::Kind::twelve_channels;
  std::vector<EmulatedDevice> devices;
  std::optional<double> battery_Ah;  ///< charge at the start of a battery, whose gauge is then at the port battery
  std::optional<double>
      floor_depth_m;                ///< of the sea floor below an altimeter, which is then at the port altimeter
  std::vector<double> floor_slope;  ///< how much deeper it is for each metre north and east; empty: level
  double noise = 0;
  double drop = 0;
  std::vector<StallPlan> stalls;
  std::vector<UnplugPlan> unplugs;
};

/// The instruments of the vehicle, live, and the devices that were asked for.
class EmulateSession {
 public:
  /// Makes the ports. Throws config::Error, Failure, std::system_error, or what ports::PtyHost
  /// throws.
  EmulateSession(boost::asio::io_context& io, const EmulateArguments& arguments);

  [[nodiscard]] const std::vector<std::unique_ptr<EmulatedPort>>& ports() const { return ports_; }
  /// nullptr when there is none of this name.
  [[nodiscard]] EmulatedPort* find(std::string_view name) const;
  /// False when no inertial card is emulated.
  bool set_imu_status(std::uint8_t status) {
    if (imu_ != nullptr) imu_->set_status(status);
    return imu_ != nullptr;
  }
  void stop() { io_.stop(); }
  /// Completes the truth file. Throws sim::UnstableVehicle or std::system_error.
  void finish();
  /// The same after an error, with the motion before it. Throws std::system_error.
  void finish_after_error();
  /// To standard error: what became of the bytes.
  void report() const;

 private:
  void add_vehicle_devices(const EmulateArguments& arguments, const sim::Origin& origin, sim::Noise& seeds);
  void add_commands(const EmulateArguments& arguments, const devices::MotorModel& model, sim::Noise& seeds);
  void add_gauges(const EmulateArguments& arguments, sim::Noise& seeds);
  void add(const EmulateArguments& arguments, std::string name, std::unique_ptr<sim::Device> device);
  void write_truth();
  [[nodiscard]] std::int64_t now_ns() const;
  void after(double seconds, std::function<void()> what);
  void stall_regularly(const StallPlan& plan);

  boost::asio::io_context& io_;
  std::int64_t utc_minus_monotonic_ns_;
  sim::EffectSet effects_;
  std::unique_ptr<sim::Motion> motion_;
  std::optional<config::Layout> layout_;
  sim::MotorCard::Obey obey_card_;           ///< by motion_
  sim::ActuatorOutputs::Obey obey_outputs_;  ///< by motion_
  std::unique_ptr<EmulateTruth> truth_;
  boost::asio::steady_timer truth_timer_;
  std::unique_ptr<SentLog> log_;
  sim::ImuCard* imu_ = nullptr;
  std::vector<std::unique_ptr<EmulatedPort>> ports_;
  std::vector<std::unique_ptr<boost::asio::steady_timer>> timers_;
};

}  // namespace navcal::emulation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/settings.h"
#include "devices/instrument_model.h"
#include "identify/data/channel.h"
#include "instruments/samples.h"
#include "record/recording.h"

namespace navcal::identify {

struct Reading {
  double time_s = 0;
  double value = 0;
  double std = 0;  ///< of its noise
};

/// One number that moves an actuator, as it was recorded: held from one time to the next.
struct Signal {
  std::vector<double> times_s, values;  ///< in order of time
  bool is_pulse = false;                ///< widths of pulses, us

  [[nodiscard]] bool empty() const { return times_s.empty(); }
};

/// What one recording says of the vehicle's motion and of its actuators. Times are seconds since its first byte.
/// Instruments and signals that it lacks are empty.
struct RecordedMotion {
  std::string name;  ///< the file
  std::array<std::vector<Reading>, kChannels> channels;
  /// Shaft speed "rpm", as reported, and "rpm_commanded"; "fin_1" to "fin_3" (rad); mission sensors by their name:
  /// "output1".
  std::map<std::string, Signal> signals;
  bool fins_are_reported = false;  ///< by a motor card: where the servos are; else where they were told to be
  /// New commands to a motor card, as they were sent: times and angles of its fins. Empty: not recorded.
  std::vector<double> order_times_s;
  std::vector<std::array<double, 3>> ordered_fins_rad;
  double duration_s = 0;

  // Places of the instruments in the body, m, by the configuration.
  Eigen::Vector3d imu_place_m = Eigen::Vector3d::Zero(), gauge_place_m = Eigen::Vector3d::Zero(),
                  doppler_place_m = Eigen::Vector3d::Zero(), antenna_place_m = Eigen::Vector3d::Zero();
  double tilt_lag_s = 0;                  ///< first-order lag of roll and pitch
  double dip_rad = 0;                     ///< of the Earth's field, by the compass
  double field_uT = 0;                    ///< its strength in the same way; 0: not known
  double gyro_turn_on_rad_s = 0;          ///< standard deviation of the bias at power-on
  bool heading_is_true = false;           ///< as the device states it; else magnetic
  bool declination_is_stated = false;     ///< by the user
  std::optional<double> declination_rad;  ///< by the configuration, else by the model at the fixes; positive east
  std::vector<std::string> remarks;

  [[nodiscard]] const std::vector<Reading>& operator[](Channel channel) const {
    return channels[static_cast<std::size_t>(channel)];
  }
  [[nodiscard]] bool has(Channel channel) const { return !(*this)[channel].empty(); }
  /// Whether a channel has two readings that differ.
  [[nodiscard]] bool varies(std::size_t channel) const {
    return std::ranges::adjacent_find(channels[channel], std::ranges::not_equal_to{}, &Reading::value) !=
           channels[channel].end();
  }
};

/// States the Earth's field of a recording: north, east, down.
void set_field(RecordedMotion& motion, const std::array<double, 3>& field_uT);

/// The same with at most one reading of each channel in `interval_s`.
[[nodiscard]] RecordedMotion thinned(RecordedMotion motion, double interval_s);

/// Motion by samples of ports of these settings from `begin_ns` on, which is the scale of their stamps.
/// `instruments`: without their mounting.
[[nodiscard]] RecordedMotion motion_of(std::span<const instruments::Sample> samples, std::int64_t begin_ns,
                                       const config::Settings& settings,
                                       const devices::InstrumentModel& instruments);

/// Reads a log or a capture through the pipeline. `stated`: the configuration to use instead of the recording's
/// own. Rates and forces that come faster than 25 times a second are averaged over 0.04 s. Of two devices with the
/// same channel the one with more readings counts. `window`: the part to read. `progress` gets 0 to 1. Throws
/// record::BadRecording.
[[nodiscard]] RecordedMotion load_motion(const std::filesystem::path& file,
                                         const std::function<void(double)>& progress,
                                         const std::optional<config::Settings>& stated = std::nullopt,
                                         const record::TimeWindow& window = {});

}  // namespace navcal::identify

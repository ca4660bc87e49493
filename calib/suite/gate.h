// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "calib/archive.h"
#include "calib/suite/reading_queue.h"

namespace navcal::calib {

/// Why a reading, or a part of one, was kept from the calibrators.
enum class Rejection : std::uint8_t {
  not_finite,          ///< a value is not a number or infinite
  absurd,              ///< no such vehicle or planet
  repeated,            ///< the stamp of the reading before
  reversed,            ///< a stamp before those already used
  faulty,              ///< the device reports an error of unknown effect
  saturated,           ///< the converter was over its range
  frozen,              ///< the same to the last digit for a second
  motor_switched,      ///< magnetic, and the motor was switched on or off about then
  tilt_out_of_range,   ///< heading and tilt, as the device reports (E002); the field is used
  field_out_of_range,  ///< heading and field, as the device reports (E004); the tilt is used
  field_too_large,     ///< the field: more than the Earth and a vehicle's iron make (kHighestField_uT)
};
inline constexpr std::size_t kRejections = 11;
[[nodiscard]] std::string_view name_of(Rejection rejection);
/// "compass", "imu", "gps", "motor".
[[nodiscard]] std::string_view name_of(Stream stream);

struct GateCounts {
  std::array<std::uint64_t, kStreams> taken{};  ///< readings that came
  std::array<std::array<std::uint64_t, kRejections>, kStreams> left_out{};
  std::array<std::uint64_t, kStreams> gaps{};  ///< nothing usable for longer than the stream's gap
  std::uint64_t restarts = 0;                  ///< time began anew
  std::uint64_t distorted = 0;  ///< readings of the compass with its remark of magnetic distortion (E001); used
  void archive(Archive& archive) { archive(taken, left_out, gaps, restarts, distorted); }
};

struct GateOptions {
  double motor_settle_s = 2;  ///< magnetic readings are left out so long after the motor was switched ...
  double motor_lead_s = 0.5;  ///< ... and so long before its card said so
  double motor_on_rpm = 30;
};

/// Sorts and filters readings before all calibrators. Readings of several instruments come in, each with the
/// latency of its instrument, and leave in the order of their times. Readings that are unfit for calibration
/// are left out and counted by reason.
/// The gate looks ahead by kDelay_s. So it finds the first readings of a frozen instrument, and those just
/// before the motor was switched, in time. Times given out never decrease: where the stamps restart (another
/// recording), they continue kRestartGap_s later.
class Gate {
 public:
  static constexpr double kDelay_s = 2;
  static constexpr double kRestartGap_s = 3600;

  explicit Gate(const GateOptions& options = {}) : options_(options) {}

  void put(const Reading& reading);
  /// The next reading that may be used, its time on the gate's own scale; nullopt while the gate still looks
  /// ahead.
  std::optional<Reading> take();
  /// Called when no more readings come: take() then gives out all that wait.
  void flush() { flushing_ = true; }
  /// Announces a pause of unknown length and another clock, as after a restart of the program.
  void restart();

  /// A time of the callers on the gate's own scale; nullopt while a new one is about to begin.
  [[nodiscard]] std::optional<double> on_own_scale(double time_s) const {
    return restart_pending_ ? std::nullopt : std::optional(time_s + offset_s_);
  }
  [[nodiscard]] const GateCounts& counts() const { return counts_; }
  void archive(Archive& archive);

 private:
  /// Length of a run of readings that are the same to the last digit.
  struct Run {
    Eigen::Vector4d value = Eigen::Vector4d::Zero();
    double since_s = 0;
    std::uint32_t length = 0;
    bool add(const Eigen::Vector4d& next, double time_s);
    void archive(Archive& archive) { archive(value, since_s, length); }
  };

  void count(Stream stream, Rejection reason);
  /// The reading's time on the gate's scale, if it is in order.
  std::optional<double> admitted_time(Stream stream, double time_s);
  /// Takes away what cannot be used; false when nothing is left.
  bool clean(CompassReading& reading);
  bool clean(RateReading& reading);
  bool clean(GroundReading& reading);
  bool clean(MotorReading& reading);
  void watch_frozen(const Reading& reading);
  void mark_frozen(bool QueuedReading::*flag, Stream stream, double since_s);
  /// Removes from a leaving reading what is frozen or disturbed by the motor; false when nothing usable is
  /// left.
  bool release(QueuedReading& entry);
  bool release(QueuedReading& entry, CompassReading& reading);
  void watch_motor(const MotorReading& motor);
  void watch_gap(Stream stream, double time_s);

  GateOptions options_;
  ReadingQueue queue_;
  GateCounts counts_;
  std::array<std::optional<double>, kStreams> newest_s_;    ///< put in, on the callers' scale
  std::array<std::optional<double>, kStreams> released_s_;  ///< given out, on the gate's scale
  double offset_s_ = 0;                                     ///< gate's scale less callers'
  double front_s_ = 0;                                      ///< newest time put in, gate's scale
  double back_s_ = 0;                                       ///< newest key given out
  bool restart_pending_ = false;
  bool flushing_ = false;
  std::uint32_t reversed_in_a_row_ = 0;
  Run field_, heading_, rates_;
  std::optional<bool> motor_on_;
  std::optional<double> motor_switched_s_;
};

}  // namespace navcal::calib

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "calib/suite/report.h"
#include "config/settings.h"
#include "instruments/clock_state.h"
#include "instruments/samples.h"
#include "pipeline/battery.h"
#include "pipeline/calibration.h"
#include "pipeline/earth_field.h"
#include "pipeline/navigation.h"
#include "pipeline/role_ports.h"
#include "pipeline/utc_mapping.h"
#include "protocols/frame.h"

namespace navcal::pipeline {

/// Alarms that follow from an estimate, not from a bit of an instrument.
enum class EstimateAlarm : std::uint8_t { battery_low, floor_near };

struct AlarmChange {
  EstimateAlarm alarm{};
  bool raised = false;
  std::uint16_t port = 0;    ///< that of the instrument whose sample showed it
  std::int64_t time_ns = 0;  ///< arrival of that sample, monotonic
  std::string words{};       ///< the value and the limit, for people
};

/// Something about a port's stream that its user should know; told once.
struct StreamEvent {
  std::uint16_t port = 0;
  std::int64_t time_ns = 0;     ///< arrival of the frame that showed it, monotonic
  std::string_view severity{};  ///< "info" or "warning", as in the log
  std::string_view name{};      ///< "clock.rate"
  std::string message{};        ///< for people
};

/// Receiver of the output. Called from within Pipeline::bytes() and Pipeline::advance(); must not call back.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void on_sample(const instruments::Sample& /*sample*/) {}
  /// Every intact frame, before the samples made of it (dialogues, counters).
  virtual void on_frame(std::uint16_t /*port*/, const protocols::Frame& /*frame*/, std::int64_t /*arrival_ns*/) {}
  /// Rate or rhythm of a port's frames are not as configured, or are so again.
  virtual void on_stream_event(const StreamEvent& /*event*/) {}
  /// The UTC mapping changed (from GPS time, or by set_mapping()).
  virtual void on_mapping(const UtcMapping& /*mapping*/) {}
  /// The calibrations changed, by themselves or by order.
  virtual void on_calibration(const CalibrationChange& /*change*/) {}
  /// The field of the compass stepped: a magnet near, a load, a motor.
  virtual void on_field_step(const calib::FieldStep& /*step*/, std::int64_t /*now_ns*/) {}
  /// The Earth's field at the vehicle became known, or is another one.
  virtual void on_earth_field(const EarthField& /*field*/) {}
  /// Where the vehicle is thought to be, at the interval of the configuration.
  virtual void on_navigation(const NavigationSample& /*sample*/) {}
  /// Charge of the battery, at the interval of the configuration.
  virtual void on_battery(const BatterySample& /*sample*/) {}
  /// An alarm that follows from an estimate was raised or cleared.
  virtual void on_alarm(const AlarmChange& /*change*/) {}
};

/// Intact frames that gave no sample and were no part of one, by kind; kinds beyond the first eight together.
class UnusedFrames {
 public:
  void add(protocols::FrameId kind);
  [[nodiscard]] std::uint64_t total() const { return total_; }
  /// "GNGNS 1100, PASHR 100, others 7".
  [[nodiscard]] std::string words() const;

 private:
  std::array<std::pair<protocols::FrameId, std::uint64_t>, 8> kinds_;  ///< with the number of frames of each
  std::uint64_t total_ = 0;
};

/// Statistics of one port's stream, counted from the beginning.
struct PortStatistics {
  protocols::Counters bytes;
  std::uint64_t held_bytes = 0;  ///< waiting in the parser
  std::uint64_t samples = 0;
  UnusedFrames unused;
  std::uint64_t out_of_range = 0;     ///< intact frames whose content cannot be (dates, angles)
  std::uint64_t silences = 0;         ///< incomplete frames given up
  std::uint64_t lost = 0;             ///< frames missing by sequence number or by the device's clock
  std::uint64_t repeated = 0;         ///< frames received twice
  std::int64_t last_frame_ns = 0;     ///< arrival of the newest intact frame, monotonic; 0: none yet
  instruments::ClockState clock;      ///< the device's own clock
  bool has_corrected_fields = false;  ///< an autopilot's own calibration was not taken off its compass
};

/// (port, arrival, bytes) -> stamped and calibrated samples. The same object live and in replay: no I/O, no clock,
/// no allocation per byte, and the same calls in the same order give bit-identical samples.
class Pipeline {
 public:
  explicit Pipeline(const config::Settings& settings);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// The bytes of one completed read; arrival on the monotonic clock, never decreasing over all calls.
  void bytes(std::uint16_t port, std::int64_t arrival_ns, protocols::Bytes bytes, Sink& sink);
  /// Time has passed without bytes: incomplete frames whose time is over are given up. bytes() does this itself.
  void advance(std::int64_t now_ns, Sink& sink);
  /// When advance() should be called next, monotonic; INT64_MAX when nothing waits.
  [[nodiscard]] std::int64_t next_deadline_ns() const;
  /// A better mapping to UTC (from the system clock); recorded, and set again in replay.
  void set_mapping(const UtcMapping& mapping, Sink& sink);
  [[nodiscard]] const UtcMapping& mapping() const;

  /// Whether there is anything to calibrate; if not, the calls below do nothing.
  [[nodiscard]] bool calibrates() const;
  /// The operator's word, or a recorded one. Returns why it cannot be done; empty: it is done.
  std::string order_calibration(CalibrationOrder order, calib::Calibrator calibrator, std::int64_t now_ns,
                                Sink& sink);
  [[nodiscard]] calib::Report calibration_report() const;
  /// The change with which a log begins. advance() must have been called with the same time, in replay too.
  [[nodiscard]] CalibrationChange calibration_beginning(std::int64_t now_ns);
  /// From such a beginning. False when its state is none of ours; nothing has changed then.
  bool restore_calibration(std::string_view state);
  /// A recorded change, made again. What follows from the bytes is not: it will happen by itself. Returns what was
  /// wrong with it, for people.
  std::string replay_calibration(const CalibrationChange& change, Sink& sink);
  /// The restored state is of an earlier run of the program.
  void begin_calibration_run();
  /// No more bytes come: the calibrators use all that they have.
  void finish_calibration(Sink& sink);

  /// The vehicle may have been anywhere since: position and attitude are estimated anew.
  void begin_navigation_run();

  /// The estimate of now, between its reports; nullopt without an estimator, and before anything came.
  [[nodiscard]] std::optional<NavigationSample> navigation() const;

  /// The battery's charge is known from here on, with one standard deviation. Does nothing where the battery is
  /// not counted (battery.enabled).
  void set_battery(const BatteryCharge& charge);
  /// The newest estimate; nullopt where the battery is not counted, and before anything came.
  [[nodiscard]] std::optional<BatterySample> battery() const;

  /// Which port serves which role now, of those that have delivered.
  [[nodiscard]] RolePorts sources() const;
  [[nodiscard]] const EarthField& earth_field() const;

  [[nodiscard]] PortStatistics statistics(std::uint16_t port) const;
  [[nodiscard]] const config::Settings& settings() const;

 private:
  struct Port;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace navcal::pipeline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "config/settings.h"
#include "daemon/latency_histogram.h"
#include "daemon/lazy_timer.h"
#include "daemon/speed_check.h"
#include "instruments/compass_calibration.h"
#include "instruments/device_command.h"
#include "instruments/oncore_aid.h"
#include "instruments/start_up.h"
#include "pipeline/pipeline.h"
#include "ports/port.h"

namespace navcal::daemon {

class PortSession;

/// Told by a session what happens at its port.
class PortOwner {
 public:
  virtual ~PortOwner() = default;
  /// Bytes are to be recorded and put through the pipeline.
  virtual void on_port_bytes(std::uint16_t port, std::int64_t arrival_ns, protocols::Bytes bytes) = 0;
  virtual void on_port_sent(std::uint16_t port, std::int64_t now_ns, protocols::Bytes bytes) = 0;
  /// "info" or "warning"; `name` as in LogEncoder::event.
  virtual void on_port_event(std::uint16_t port, std::int64_t now_ns, std::string_view severity,
                             std::string_view name, std::string_view message) = 0;
  virtual void on_port_changed(std::uint16_t port) = 0;
  /// Where the vehicle is thought to be, and the time, for a receiver that has lost both; nullopt: not known.
  [[nodiscard]] virtual std::optional<instruments::ReceiverAid> receiver_aid(std::int64_t now_ns) const = 0;
  /// A compass has come to the end of the calibration of itself, good or bad. Not within on_port_bytes().
  virtual void on_compass_calibrated(std::uint16_t port, std::int64_t now_ns,
                                     const instruments::CompassCalibration& calibration) = 0;
};

/// One configured port at work: the port itself, the device's start-up dialogue, and what is known of both.
class PortSession : private ports::PortListener {
 public:
  enum class State {
    away,       ///< not there, or cannot be opened
    silent,     ///< open, and nothing comes
    no_frames,  ///< bytes come, but no intact frame
    noisy,      ///< intact frames between much that is none
    running,
    off,  ///< its supply is switched off, or has just been switched on
  };

  PortSession(const boost::asio::any_io_executor& executor, std::uint16_t port,
              const config::PortSettings& settings, PortOwner& owner);

  void start() { port_.start(); }
  void stop();

  /// Send as in ports::Port: send_now() sends a whole line at once or nothing. flush() waits until it is on the
  /// wire, no longer than `limit`.
  [[nodiscard]] std::optional<std::int64_t> send_now(protocols::Bytes bytes) {
    return off_ ? std::nullopt : port_.send_now(bytes);
  }
  void flush(std::chrono::milliseconds limit) { port_.flush(limit); }
  /// Called by the pipeline within on_port_bytes().
  void on_frame(const protocols::Frame& frame, std::int64_t arrival_ns);
  void published(std::int64_t latency_ns) { latency_.add(latency_ns); }
  /// Lets a compass calibrate itself. Returns why it cannot; empty: it has begun.
  [[nodiscard]] std::string calibrate_compass(std::int64_t now_ns);
  /// Ends the calibration once the vehicle has turned enough. Returns why that is impossible; empty: the score
  /// will be read.
  [[nodiscard]] std::string stop_calibrating_compass(std::int64_t now_ns);
  /// Lets the compass keep the result. Returns why it cannot; empty: it was begun.
  [[nodiscard]] std::string save_compass_calibration(std::int64_t now_ns);
  /// The supply of the device was switched off, or on but not settled: nothing is sent, and silence is no fault.
  void power_off(std::int64_t now_ns, std::string reason);
  /// The device has its supply again: the start-up dialogue begins.
  void power_on(std::int64_t now_ns);
  /// Calibrated yaw rate of the vehicle; called by the pipeline.
  void on_yaw_rate(double rate_rad_s, std::int64_t now_ns);
  /// Null when the device has no calibration of itself.
  [[nodiscard]] const instruments::CompassCalibration* compass_calibration() const {
    return compass_calibration_.get();
  }
  /// Gives the device a command of instruments/device_command.h. Returns why it cannot be; empty: it has begun,
  /// and an event will tell its end. A command that needs force is refused without `force`.
  [[nodiscard]] std::string command_device(std::string_view name, bool force, std::int64_t now_ns);
  /// The newest of these commands.
  struct GivenCommand {
    std::string name;
    std::uint64_t number = 0;                                    ///< counts them at this port, from 1
    std::optional<instruments::DeviceCommand::Outcome> outcome;  ///< nullopt: under way
  };
  [[nodiscard]] const std::optional<GivenCommand>& given_command() const { return given_command_; }
  /// Called about once a second: judges the state.
  void tick(std::int64_t now_ns, const pipeline::PortStatistics& statistics);

  [[nodiscard]] const config::PortSettings& settings() const { return settings_; }
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// The open port; nullopt while the device is absent or switched off.
  [[nodiscard]] const std::optional<ports::OpenPort>& open_port() const {
    static const std::optional<ports::OpenPort> kNone;
    return off_ ? kNone : open_;
  }
  [[nodiscard]] std::int64_t opened_ns() const { return opened_ns_; }
  [[nodiscard]] std::uint64_t times_opened() const { return times_opened_; }
  /// State of the start-up dialogue, for people; empty for a device without one.
  [[nodiscard]] std::string start_up_state() const { return start_up_ ? start_up_->state() : std::string(); }
  [[nodiscard]] const LatencyHistogram& latency() const { return latency_; }

 private:
  void on_opened(std::int64_t now_ns, const ports::OpenPort& port) override;
  void on_bytes(std::int64_t arrival_ns, protocols::Bytes bytes) override;
  void on_sent(std::int64_t now_ns, protocols::Bytes bytes) override;
  void on_lost(std::int64_t now_ns, std::string_view reason) override;

  void talk(std::int64_t now_ns);
  void end_calibration(std::int64_t now_ns);
  void abandon_calibration(std::int64_t now_ns, const std::string& reason);
  void aid_receiver(std::int64_t now_ns);
  /// True while the calibration dialogue has the device to itself.
  bool talk_of_calibration(std::int64_t now_ns);
  /// Why a command cannot be given now; empty: it can.
  [[nodiscard]] std::string why_no_command(std::string_view name, bool force) const;
  /// True while an operator's command has the device to itself.
  bool talk_of_command(std::int64_t now_ns);
  void end_command(std::int64_t now_ns, instruments::DeviceCommand::Outcome outcome);
  void set_state(std::int64_t now_ns, State state, std::string reason);
  State judge(const pipeline::PortStatistics& statistics, std::int64_t now_ns, std::string& reason);

  const std::uint16_t index_;
  const config::PortSettings settings_;
  PortOwner& owner_;
  std::unique_ptr<instruments::StartUp> start_up_;
  std::unique_ptr<instruments::CompassCalibration> compass_calibration_;
  std::optional<instruments::OncoreAid> aid_;  ///< of a receiver that is to be aided
  bool calibrating_compass_ = false;
  std::unique_ptr<instruments::DeviceCommand> command_;  ///< under way
  std::optional<GivenCommand> given_command_;
  bool saving_calibration_ = false;  ///< the dialogue is that of save(): nothing new was found
  LazyTimer talk_timer_;
  std::string last_start_up_state_;
  SpeedCheck speed_check_;
  LatencyHistogram latency_;
  std::optional<ports::OpenPort> open_;
  std::int64_t opened_ns_ = 0;
  std::int64_t last_bytes_ns_ = 0;
  std::uint64_t times_opened_ = 0;
  bool opened_anew_ = false;  ///< since the last tick
  bool off_ = false;          ///< no supply
  State state_ = State::away;
  std::string reason_ = "not opened yet";
  ports::Port port_;
};

/// "away", "silent", "no_frames", "noisy", "running", "off".
[[nodiscard]] std::string_view name_of(PortSession::State state);

}  // namespace navcal::daemon

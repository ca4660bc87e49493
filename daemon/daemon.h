// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "daemon/alarms.h"
#include "daemon/battery_keeper.h"
#include "daemon/calibrations.h"
#include "daemon/control_server.h"
#include "daemon/health.h"
#include "daemon/lazy_timer.h"
#include "daemon/listeners.h"
#include "daemon/log_writer.h"
#include "daemon/motor_control.h"
#include "daemon/nmea_feed.h"
#include "daemon/notifier.h"
#include "daemon/port_session.h"
#include "daemon/power_control.h"
#include "daemon/publisher.h"
#include "daemon/remote_link.h"
#include "daemon/remote_report.h"
#include "daemon/state_collector.h"
#include "daemon/status_server.h"
#include "pipeline/pipeline.h"
#include "pipeline/utc_mapping.h"

namespace navcal::daemon {

/// The service: ports, pipeline, log and sockets put together on one I/O thread. Bytes arrive from a port, go into
/// the log as they are, through the pipeline, and come back as samples, which are published and logged.
class Daemon : private pipeline::Sink,
               private PortOwner,
               private StatusSource,
               private MotorOwner,
               private ControlOwner,
               private PowerOwner,
               private RemoteOwner {
 public:
  /// Opens the sockets, which it cannot do without. `second_note`: of MotorControl. Throws StartError.
  Daemon(const boost::asio::any_io_executor& executor, const config::Settings& settings, ActivatedSockets sockets,
         const std::filesystem::path& second_note);
  ~Daemon() override;

  void start();
  /// Closes everything as soon as the motor card has shown the safe state, or at a second call; after that the
  /// executor runs out of work, and finish() brings the log to its end. `stopped` is called when all is closed.
  void stop(std::string_view reason, std::function<void()> stopped);
  /// False: the card may still have an order.
  [[nodiscard]] bool finish();
  void rotate_log();

  [[nodiscard]] std::uint16_t status_port() const { return server_.port(); }

 private:
  // pipeline::Sink
  void on_sample(const instruments::Sample& sample) override;
  void on_frame(std::uint16_t port, const protocols::Frame& frame, std::int64_t arrival_ns) override;
  void on_mapping(const pipeline::UtcMapping& mapping) override;
  void on_calibration(const pipeline::CalibrationChange& change) override;
  void on_field_step(const calib::FieldStep& step, std::int64_t now_ns) override;
  void on_navigation(const pipeline::NavigationSample& sample) override;
  void on_battery(const pipeline::BatterySample& sample) override;
  void on_alarm(const pipeline::AlarmChange& change) override;
  void on_stream_event(const pipeline::StreamEvent& event) override;
  void on_earth_field(const pipeline::EarthField& field) override;
  // PortOwner
  void on_port_bytes(std::uint16_t port, std::int64_t arrival_ns, protocols::Bytes bytes) override;
  void on_port_sent(std::uint16_t port, std::int64_t now_ns, protocols::Bytes bytes) override;
  void on_port_event(std::uint16_t port, std::int64_t now_ns, std::string_view severity, std::string_view name,
                     std::string_view message) override;
  void on_port_changed(std::uint16_t port) override;
  [[nodiscard]] std::optional<instruments::ReceiverAid> receiver_aid(std::int64_t now_ns) const override;
  void on_compass_calibrated(std::uint16_t port, std::int64_t now_ns,
                             const instruments::CompassCalibration& calibration) override;
  // StatusSource
  [[nodiscard]] std::uint16_t device_count() const override {
    return static_cast<std::uint16_t>(settings_.ports.size());
  }
  [[nodiscard]] std::optional<std::uint16_t> device_named(std::string_view name) const override;
  [[nodiscard]] std::string_view device_name(std::uint16_t port) const override;
  void append_device(std::string& out, std::uint16_t port) const override;
  void append_poll(std::string& out) const override;
  void on_watch_changed() override { state_timer_.arm(server_.next_state_ns()); }
  // MotorOwner
  void on_motor_event(std::int64_t now_ns, std::string_view severity, std::string_view name,
                      std::string_view message) override;
  void on_motor_deaf(std::int64_t now_ns, bool is_deaf) override;
  void on_motor_unnoted(std::int64_t now_ns, bool is_unnoted) override;
  // ControlOwner
  [[nodiscard]] ControlAnswer on_control(const ControlRequest& request, const ControlOrigin& origin) override {
    return answer(request, origin);
  }
  void control_client_gone(std::uint64_t client, std::string_view reason) override;
  // RemoteOwner
  [[nodiscard]] link::Report remote_report(std::int64_t now_ns) override;
  void remote_answer(const ControlRequest& request, const ControlOrigin& origin, Reply reply) override;
  void remote_client_gone(std::uint64_t client) override {
    control_client_gone(client, "its connection was closed");
  }
  void end_every_lease() override;
  [[nodiscard]] bool is_in_charge(std::uint64_t client) const override {
    return motor_ && motor_->command().holder() && motor_->command().holder()->client == client;
  }
  void on_remote_event(std::int64_t now_ns, std::string_view severity, std::string_view name,
                       std::string_view message) override {
    event(now_ns, severity, name, "remote", message);
  }
  void on_remote_dead(std::int64_t now_ns, bool is_dead) override;

  // PowerOwner
  void on_power_event(std::int64_t now_ns, std::string_view severity, std::string_view name,
                      std::string_view message) override {
    event(now_ns, severity, name, "", message);
  }
  [[nodiscard]] std::string why_power_stays(std::uint16_t port) const override {
    return motor_ && port == motor_port_ ? motor_->why_power_stays() : std::string();
  }

  [[nodiscard]] ControlAnswer answer(const ControlRequest& request, const ControlOrigin& origin);
  [[nodiscard]] std::string answer_status() const;
  [[nodiscard]] ControlAnswer answer_log(const ControlRequest& request);
  [[nodiscard]] std::string answer_log_select(const ControlRequest& request);
  void start_log();
  void stop_log();
  [[nodiscard]] std::string answer_battery(const ControlRequest& request);
  void set_battery(const pipeline::BatteryCharge& charge, std::string_view cause);
  /// STATE at its rates, and the next ring of its timer.
  void ring_state();
  /// With alarms and who holds the motor.
  [[nodiscard]] VehicleState vehicle_state(std::int64_t now_ns);
  [[nodiscard]] const std::string& state_report(std::int64_t now_ns);
  [[nodiscard]] std::string answer_compass(const ControlRequest& request);
  [[nodiscard]] std::string answer_device(const ControlRequest& request);
  /// The first session whose calibration of itself has this name; null: there is none.
  [[nodiscard]] PortSession* compass_named(std::string_view name) const;
  void turn_compasses(double yaw_rate_rad_s, std::int64_t now_ns);
  /// Members of CALIB: what each compass says of its calibration of itself.
  [[nodiscard]] std::string compasses_json() const;
  void event(std::int64_t now_ns, std::string_view severity, std::string_view name, std::string_view port,
             std::string_view message);
  /// An alarm that the daemon has judged: told where it changes.
  void set_alarm(std::uint16_t port, Alarm alarm, bool stands, std::int64_t now_ns, std::string_view words = {});
  void stop_when_safe();
  void update_alarms(const instruments::Sample& sample, const instruments::ImuSample& imu);
  /// Tells the motor of leaks that were raised or are over.
  void react_to_leaks(const std::vector<Alarms::Change>& changes, std::int64_t now_ns);
  /// What is due on a word of the compass that serves.
  void note_word(const instruments::Sample& sample);
  void publish_words();
  void advance();
  void tick();
  void watch_system_clock();
  void report_health(std::int64_t now_ns);
  [[nodiscard]] std::vector<std::string> health(std::int64_t now_ns) const;
  [[nodiscard]] std::string summary() const;
  [[nodiscard]] std::optional<std::int64_t> utc(std::int64_t monotonic_ns) const;

  const boost::asio::any_io_executor executor_;
  const config::Settings settings_;
  const std::string identity_ = vehicle_identity(settings_);
  const std::int64_t started_ns_;
  const std::int64_t tick_ns_;
  pipeline::Pipeline pipeline_;
  pipeline::SystemClockWatch clock_watch_;
  StatusServer server_;
  ControlServer control_;
  LogWriter log_;  ///< after the sockets: a second daemon must not begin a file before it finds them taken
  Calibrations calibrations_;
  BatteryKeeper battery_;
  Publisher publisher_;
  NmeaFeed nmea_;
  Notifier notifier_;
  Alarms alarms_;
  std::vector<std::unique_ptr<PortSession>> sessions_;
  std::optional<std::uint16_t> motor_port_;
  std::unique_ptr<MotorControl> motor_;  ///< null where no orders are taken
  PowerControl power_;
  std::unique_ptr<RemoteLink> remote_;  ///< null where there is none
  RemoteReport remote_report_;
  std::optional<boost::asio::thread_pool>
      remote_reader_;  ///< one thread, for answers to operators that need the disk
  StateCollector state_;
  std::string state_report_;
  bool word_came_ = false;                          ///< within these bytes, from the compass that serves
  std::optional<instruments::CompassSample> word_;  ///< the last of them that NMEA sentences are due for
  std::uint16_t word_port_ = 0;
  LazyTimer state_timer_;
  LazyTimer deadline_timer_;
  LazyTimer tick_timer_;
  LazyTimer stop_timer_;
  std::int64_t stop_at_ns_ = 0;  ///< whatever the card shows; 0: nobody has asked to stop
  std::string stop_reason_;
  std::function<void()> stopped_;
  std::int64_t next_tick_ns_ = 0;
  std::int64_t next_health_ns_ = 0;
};

}  // namespace navcal::daemon

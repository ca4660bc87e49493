// SPDX-License-Identifier: Apache-2.0
#include "daemon/daemon.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "base/angles.h"
#include "daemon/health.h"
#include "daemon/listeners.h"
#include "daemon/system_clock.h"
#include "record/json/mapping_json.h"

namespace navcal::daemon {
namespace asio = boost::asio;
namespace {

constexpr double kTick_s = 1;
/// The end waits for so long for the card to show the safe state; TimeoutStopSec of the unit is longer.
constexpr std::int64_t kStop_ns = 15'000'000'000;
constexpr std::int64_t kStopLook_ns = 10'000'000;

spdlog::level::level_enum level_of(std::string_view severity) {
  if (severity == "alarm") return spdlog::level::critical;
  if (severity == "error") return spdlog::level::err;
  return severity == "warning" ? spdlog::level::warn : spdlog::level::info;
}

/// The mapping with which the first log file begins; the pipeline gets the same one as soon as it can be told.
pipeline::UtcMapping first_mapping() {
  return pipeline::SystemClockWatch().update(read_system_clock(), {}).mapping.value_or(pipeline::UtcMapping{});
}

}  // namespace

Daemon::Daemon(const asio::any_io_executor& executor, const config::Settings& settings, ActivatedSockets sockets,
               const std::filesystem::path& second_note)
    : executor_(executor), settings_(settings), started_ns_(ports::monotonic_ns()),
      tick_ns_(static_cast<std::int64_t>(std::min(kTick_s, settings.status.health_interval_s) * 1e9)),
      pipeline_(settings_),
      server_(sockets.status ? std::move(*sockets.status) : listen_status(executor, settings_.status),
              settings_.status, *this),
      control_(sockets.control ? std::move(*sockets.control) : listen_control(executor, settings_.control),
               sockets.control ? std::filesystem::path() : settings_.control.socket, *this),
      log_(settings_, started_ns_, first_mapping()), calibrations_(settings_, pipeline_, log_, server_),
      battery_(settings_), publisher_(settings_, server_), nmea_(settings_, pipeline_, server_),
      notifier_(executor), motor_port_(daemon::motor_port(settings_)),
      power_(executor, settings_, sessions_, *this), state_(settings_, pipeline_),
      state_timer_(executor, [this] { ring_state(); }), deadline_timer_(executor, [this] { advance(); }),
      tick_timer_(executor, [this] { tick(); }), stop_timer_(executor, [this] { stop_when_safe(); }) {
  log_.tell(server_);
  PortOwner& owner = *this;
  for (std::uint16_t port = 0; port < Daemon::device_count(); ++port) {
    sessions_.push_back(std::make_unique<PortSession>(executor, port, settings_.ports[port], owner));
  }
  if (motor_port_) {
    MotorOwner& motor_owner = *this;
    motor_ = std::make_unique<MotorControl>(executor, settings_, second_note, *sessions_[*motor_port_], log_,
                                            pipeline_, motor_owner);
  }
  RemoteOwner& remote_owner = *this;
  if (settings_.remote.enabled()) remote_ = std::make_unique<RemoteLink>(executor, settings_.remote, remote_owner);
}

Daemon::~Daemon() = default;

void Daemon::start() {
  event(started_ns_, "info", "daemon.start", "", "navcald " NAVCAL_VERSION);
  watch_system_clock();
  calibrations_.begin(ports::monotonic_ns());
  power_.begin(ports::monotonic_ns());
  if (const auto charge = battery_.load()) set_battery(*charge, "of the last run");
  for (const auto& session : sessions_) session->start();
  server_.start();
  control_.start();
  if (remote_) remote_->start();
  next_tick_ns_ = next_health_ns_ = ports::monotonic_ns();
  tick();
  notifier_.ready();
}

void Daemon::stop(std::string_view reason, std::function<void()> stopped) {
  const std::int64_t now_ns = ports::monotonic_ns();
  if (stop_at_ns_ > 0) {
    stop_at_ns_ = now_ns;
    return stop_timer_.arm(now_ns + kStopLook_ns);
  }
  stopped_ = std::move(stopped);
  notifier_.stopping();
  stop_reason_ = reason;
  stop_at_ns_ = now_ns + kStop_ns;
  if (motor_) motor_->begin_stop();
  if (motor_ && !motor_->is_safe())
    event(now_ns, "info", "daemon.stop", "",
          "waits until the motor card shows the safe state; a second signal ends it");
  stop_timer_.arm(now_ns + kStopLook_ns);
}

void Daemon::stop_when_safe() {
  const std::int64_t now_ns = ports::monotonic_ns();
  if (motor_ && !motor_->is_safe() && now_ns < stop_at_ns_) return stop_timer_.arm(now_ns + kStopLook_ns);
  // Replay will advance to the time of the event that follows: what it then gives up must have been given up here.
  pipeline_.advance(now_ns, *this);
  event(now_ns, "info", "daemon.stop", "", stop_reason_);
  if (remote_) remote_->stop();
  if (motor_) motor_->stop();
  power_.stop();
  for (const auto& session : sessions_) session->stop();
  state_timer_.stop();
  deadline_timer_.stop();
  tick_timer_.stop();
  stop_timer_.stop();
  server_.stop();
  control_.stop();
  stopped_();
}

bool Daemon::finish() {
  const std::int64_t now_ns = ports::monotonic_ns();
  for (const std::string& line : health(now_ns)) log_.health(now_ns, line + "}");
  calibrations_.stop(now_ns);
  battery_.stop();
  log_.finish(now_ns);
  for (const std::string& notice : log_.take_notices()) spdlog::warn("log: {}", notice);
  const bool is_safe = !motor_ || motor_->is_safe();
  if (!is_safe) spdlog::critical("the motor card has not shown the safe state: the shaft may turn");
  return is_safe;
}

void Daemon::rotate_log() {
  const std::int64_t now_ns = ports::monotonic_ns();
  event(now_ns, "info", "log.rotate", "", "on request");
  pipeline_.advance(now_ns, *this);  // the new file begins with the calibrators as they are then
  log_.rotate(now_ns);
}

void Daemon::on_port_bytes(std::uint16_t port, std::int64_t arrival_ns, protocols::Bytes bytes) {
  log_.raw(port, record::Direction::received, arrival_ns, bytes);
  pipeline_.bytes(port, arrival_ns, bytes, *this);
  publish_words();  // behind the pipeline, so that the estimate has the word in it
  deadline_timer_.arm(pipeline_.next_deadline_ns());
}

void Daemon::on_port_sent(std::uint16_t port, std::int64_t now_ns, protocols::Bytes bytes) {
  log_.raw(port, record::Direction::sent, now_ns, bytes);
}

void Daemon::on_frame(std::uint16_t port, const protocols::Frame& frame, std::int64_t arrival_ns) {
  sessions_[port]->on_frame(frame, arrival_ns);
}

void Daemon::on_sample(const instruments::Sample& sample) {
  publisher_.sample(sample);
  sessions_[sample.port]->published(ports::monotonic_ns() - sample.stamp.arrival_ns);
  log_.sample(sample);
  state_.take(sample);
  nmea_.sample(sample);
  note_word(sample);
  if (const auto* motor = std::get_if<instruments::MotorSample>(&sample.value);
      motor != nullptr && motor_ && sample.port == motor_port_)
    motor_->status(sample.stamp, *motor);
  if (const auto* imu = std::get_if<instruments::ImuSample>(&sample.value)) {
    update_alarms(sample, *imu);
    if (imu->yaw_rate_calibrated_rad_s) turn_compasses(*imu->yaw_rate_calibrated_rad_s, sample.stamp.arrival_ns);
  }
}

void Daemon::note_word(const instruments::Sample& sample) {
  const bool wants_nmea = nmea_.wants_vehicle(sample.port);
  if ((!wants_nmea && !server_.wants_state_of_words()) || !state_.is_serving_compass(sample)) return;
  word_came_ = true;
  if (!wants_nmea) return;
  word_ = std::get<instruments::CompassSample>(sample.value);
  word_port_ = sample.port;
}

void Daemon::publish_words() {
  if (!word_came_) return;
  word_came_ = false;
  const std::int64_t now_ns = ports::monotonic_ns();
  if (server_.wants_state_of_words()) server_.publish_state(state_report(now_ns), now_ns, true);
  if (!word_) return;
  nmea_.vehicle(word_port_, &*word_, state_.at(now_ns));
  word_.reset();
}

void Daemon::on_mapping(const pipeline::UtcMapping& mapping) {
  const std::int64_t now_ns = ports::monotonic_ns();
  publisher_.set_utc_known(mapping.source != pipeline::UtcMapping::Source::none);
  log_.mapping(now_ns, mapping);
  const bool bounded = mapping.bound_ns != pipeline::UtcMapping::kUnknownBound;
  spdlog::info("UTC from {}, {}", pipeline::name_of(mapping.source),
               bounded ? fmt::format("to within {:.6f} s", static_cast<double>(mapping.bound_ns) * 1e-9)
                       : std::string("its error is not known"));
}

void Daemon::on_calibration(const pipeline::CalibrationChange& change) {
  calibrations_.on_change(change);
  const bool forced = change.cause == pipeline::CalibrationChange::Cause::force;
  event(change.time_ns, forced ? "warning" : "info", "calibration.changed", "",
        fmt::format("{} {}: active is now {}{}", calib::name_of(change.calibrator.value()),
                    pipeline::name_of(change.cause), change.name.text(),
                    forced ? "; activated by an operator command with force" : ""));
}

void Daemon::on_field_step(const calib::FieldStep& step, std::int64_t now_ns) {
  event(now_ns, step.is_place ? "info" : "warning", step.is_place ? "field.place" : "field.step", "",
        calib::words_of(step));
}

void Daemon::on_earth_field(const pipeline::EarthField& field) { publisher_.set_earth_field(field); }

void Daemon::on_navigation(const pipeline::NavigationSample& sample) {
  publisher_.navigation(sample);
  nmea_.navigation(sample);
  if (!pipeline_.sources()[config::Role::heading] && nmea_.wants_vehicle(std::nullopt))
    nmea_.vehicle(std::nullopt, nullptr, state_.at(ports::monotonic_ns()));
  log_.navigation(sample);
  for (const auto& told : pipeline::events_of(sample))
    event(sample.stamp.arrival_ns, told.severity, told.name, "", told.message);
}

void Daemon::set_alarm(std::uint16_t port, Alarm alarm, bool stands, std::int64_t now_ns, std::string_view words) {
  if (!alarms_.set(port, alarm, stands, now_ns)) return;
  const std::string_view beside = place_beside_ports(port);
  event(now_ns, stands ? "alarm" : "info", stands ? "alarm.raised" : "alarm.cleared",
        beside.empty() ? settings_.ports[port].name : beside,
        words.empty() ? std::string(name_of(alarm)) : fmt::format("{}: {}", name_of(alarm), words));
  // Whoever watches is to see it now, not at the next report.
  report_health(now_ns);
}

void Daemon::update_alarms(const instruments::Sample& sample, const instruments::ImuSample& imu) {
  const auto& changes = alarms_.update(sample.port, imu, sample.stamp.arrival_ns);
  for (const auto& change : changes) {
    event(sample.stamp.arrival_ns, change.raised ? "alarm" : "info",
          change.raised ? "alarm.raised" : "alarm.cleared", settings_.ports[sample.port].name,
          name_of(change.alarm));
  }
  if (motor_ && !changes.empty()) react_to_leaks(changes, sample.stamp.arrival_ns);
  // Whoever watches is to see it now, not at the next report.
  if (!changes.empty()) report_health(sample.stamp.arrival_ns);
}

void Daemon::on_stream_event(const pipeline::StreamEvent& stream_event) {
  on_port_event(stream_event.port, stream_event.time_ns, stream_event.severity, stream_event.name,
                stream_event.message);
}

void Daemon::on_port_event(std::uint16_t port, std::int64_t now_ns, std::string_view severity,
                           std::string_view name, std::string_view message) {
  event(now_ns, severity, name, settings_.ports[port].name, message);
}

std::optional<instruments::ReceiverAid> Daemon::receiver_aid(std::int64_t now_ns) const {
  // A receiver expects other satellites where the position is off by more.
  constexpr double kMostStd_m = 20'000;
  const auto navigation = pipeline_.navigation();
  const auto& mapping = pipeline_.mapping();
  const bool known = navigation && navigation->latitude_rad && navigation->longitude_rad &&
                     navigation->estimate.position_std_m.maxCoeff() <= kMostStd_m;
  if (!known || mapping.source == pipeline::UtcMapping::Source::none) return std::nullopt;
  // On the surface of the sea; the geoid is within 110 m of the ellipsoid, which a receiver does not notice.
  return instruments::ReceiverAid{{*navigation->latitude_rad * base::kDegreesPerRadian,
                                   *navigation->longitude_rad * base::kDegreesPerRadian, 0},
                                  mapping.to_utc(now_ns)};
}

void Daemon::on_port_changed(std::uint16_t port) {
  const std::int64_t now_ns = ports::monotonic_ns();
  if (motor_ && port == motor_port_) motor_->port_changed(now_ns);
  server_.publish_device(port);
  report_health(now_ns);
}

void Daemon::event(std::int64_t now_ns, std::string_view severity, std::string_view name, std::string_view port,
                   std::string_view message) {
  log_.event(now_ns, severity, name, port, message);
  spdlog::log(level_of(severity), "{}{}{}: {}", port, port.empty() ? "" : " ", name, message);
}

/// Frames that stayed incomplete for too long are given up.
void Daemon::advance() {
  pipeline_.advance(ports::monotonic_ns(), *this);
  deadline_timer_.arm(pipeline_.next_deadline_ns());
}

void Daemon::tick() {
  const std::int64_t now_ns = ports::monotonic_ns();
  watch_system_clock();
  for (std::uint16_t port = 0; port < device_count(); ++port) {
    sessions_[port]->tick(now_ns, pipeline_.statistics(port));
  }
  pipeline_.advance(now_ns, *this);
  log_.tick(now_ns);
  calibrations_.tick(now_ns);
  for (const std::string& notice : calibrations_.take_notices())
    event(now_ns, "warning", "calibration.notice", "", notice);
  for (const std::string& notice : battery_.take_notices()) event(now_ns, "warning", "battery.notice", "", notice);
  for (const std::string& notice : log_.take_notices()) event(now_ns, "warning", "log.notice", "", notice);
  for (const std::string& notice : motor_ ? motor_->take_notices() : std::vector<std::string>())
    event(now_ns, "warning", "motor.notice", "", notice);
  const DiskState log = log_.state();
  const bool is_failing = log.state == DiskState::State::full || log.state == DiskState::State::failing;
  set_alarm(kLogPort, Alarm::log_failing, is_failing, now_ns, log.reason);
  if (now_ns >= next_health_ns_) {
    report_health(now_ns);
    calibrations_.set_compasses(compasses_json());
    calibrations_.report(now_ns);
    next_health_ns_ = now_ns + static_cast<std::int64_t>(settings_.status.health_interval_s * 1e9) - tick_ns_ / 2;
  }
  notifier_.status(summary());
  next_tick_ns_ = std::max(next_tick_ns_ + tick_ns_, now_ns);
  tick_timer_.arm(next_tick_ns_);
}

void Daemon::watch_system_clock() {
  const auto reading = read_system_clock();
  const auto outcome = clock_watch_.update(reading, pipeline_.mapping());
  if (outcome.step_ns) {
    event(reading.monotonic_ns, "warning", "clock.step", "",
          fmt::format("the system clock was set by {:+.3f} s; stamps stay as they are",
                      static_cast<double>(*outcome.step_ns) * 1e-9));
  }
  if (outcome.mapping) pipeline_.set_mapping(*outcome.mapping, *this);
}

void Daemon::report_health(std::int64_t now_ns) {
  auto lines = health(now_ns);
  for (const std::string& line : lines) log_.health(now_ns, line + "}");
  server_.publish_health(std::move(lines));
  if (server_.watched(ReportClass::time)) {
    std::string report;
    record::append_json(report, now_ns, pipeline_.mapping());
    server_.publish(ReportClass::time, report + "\r\n");
  }
  if (server_.watched(ReportClass::log)) {
    std::string report;
    append_log_report(report, log_.enabled(), log_.state(), log_.left_out());
    server_.publish(ReportClass::log, report);
  }
}

std::vector<std::string> Daemon::health(std::int64_t now_ns) const {
  Health health;
  health.heading_source = state_.heading_source();
  health.utc_ns = utc(now_ns);
  health.uptime_s = static_cast<double>(now_ns - started_ns_) * 1e-9;
  health.alarms = alarms_.standing();
  if (motor_) health.motor = motor_->health(now_ns);
  if (remote_) health.remote = remote_->health();
  health.vehicle = identity_;
  health.ports = sessions_;
  health.pipeline = &pipeline_;
  health.log_enabled = log_.enabled();
  health.log = log_.state();
  health.clients = server_.clients();
  health.client_queue_bytes = server_.queued_bytes();
  health.client_dropped = server_.dropped();
  return health_beginnings(health);
}

std::string Daemon::summary() const {
  const auto running = std::ranges::count_if(
      sessions_, [](const auto& session) { return session->state() == PortSession::State::running; });
  std::string text =
      fmt::format("{} of {} ports running, {} clients", running, sessions_.size(), server_.clients());
  for (const auto& session : sessions_) {
    if (session->state() == PortSession::State::off) text += fmt::format(", {} off", session->settings().name);
  }
  for (const auto& alarm : alarms_.standing()) text += fmt::format(", ALARM {}", name_of(alarm.alarm));
  if (const auto log = log_.state(); log.state != DiskState::State::writing) {
    text += fmt::format(", log {}", name_of(log.state));
  }
  return text;
}

std::optional<std::int64_t> Daemon::utc(std::int64_t monotonic_ns) const {
  const auto& mapping = pipeline_.mapping();
  if (mapping.source == pipeline::UtcMapping::Source::none) return std::nullopt;
  return mapping.to_utc(monotonic_ns);
}

}  // namespace navcal::daemon

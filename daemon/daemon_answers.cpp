// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "daemon/daemon.h"
#include "daemon/gpsd_replies.h"
#include "daemon/health.h"
#include "daemon/json_text.h"
#include "daemon/log_answers.h"

namespace navcal::daemon {

// What the daemon answers on its two sockets.
namespace {

constexpr std::string_view kOk = "{\"ok\":true}\n";

std::string_view why_no_orders(const config::Settings& settings) {
  return settings.command.enabled ? "the configuration has no motor card"
                                  : "orders are switched off (command.enabled)";
}

}  // namespace

std::optional<std::uint16_t> Daemon::device_named(std::string_view name) const {
  for (std::uint16_t port = 0; port < device_count(); ++port) {
    if (settings_.ports[port].name == name) return port;
  }
  if (name == pipeline::kNavigationDevice) return navigation_device(settings_);
  return std::nullopt;
}

std::string_view Daemon::device_name(std::uint16_t port) const {
  return port == navigation_device(settings_) ? pipeline::kNavigationDevice : settings_.ports[port].name;
}

void Daemon::append_device(std::string& out, std::uint16_t port) const {
  const auto& settings = settings_.ports[port];
  const auto& session = *sessions_[port];
  DeviceState device;
  device.name = settings.name;
  device.driver = protocols::name_of(settings.protocol);
  device.baud = settings.baud;
  device.cycle_s = settings.rate_Hz > 0 ? 1 / settings.rate_Hz : 0;
  // gpsd's clients ask which devices are receivers.
  device.gps = config::can_deliver(settings, config::Role::position);
  if (session.open_port()) {
    device.tty = session.open_port()->path;
    device.activated_utc_ns = utc(session.opened_ns());
  }
  append_device_object(out, device);
}

void Daemon::append_poll(std::string& out) const { publisher_.append_poll(out, utc(ports::monotonic_ns())); }

ControlAnswer Daemon::answer(const ControlRequest& request, const ControlOrigin& origin) {
  switch (request.command) {
    case ControlCommand::event:
      event(ports::monotonic_ns(), "info", "mark", "", request.text);
      return std::string(kOk);
    case ControlCommand::log_rotate:
    case ControlCommand::log_start:
    case ControlCommand::log_stop:
    case ControlCommand::log_select:
    case ControlCommand::log_list:
    case ControlCommand::log_read:
    case ControlCommand::log_sum: return answer_log(request);
    case ControlCommand::power_on:
    case ControlCommand::power_off:
    case ControlCommand::power_list: return power_.answer(request);
    case ControlCommand::calibration_start:
    case ControlCommand::calibration_accept:
    case ControlCommand::calibration_rollback:
      // The compass's own procedure is a dialogue with the device, not one of our calibrators.
      if (instruments::is_compass_calibration(request.calibrator)) return answer_compass(request);
      return calibrations_.answer(request, ports::monotonic_ns(), *this);
    case ControlCommand::calibration_stop:
      if (instruments::is_compass_calibration(request.calibrator)) return answer_compass(request);
      return control_error(
          "only tcm2 and pni, a compass's own calibration, can be stopped; navcald's calibrators run all the "
          "time");
    case ControlCommand::motor_lease:
    case ControlCommand::motor_order:
    case ControlCommand::motor_release:
    case ControlCommand::motor_stop:
      if (!motor_) return control_error(why_no_orders(settings_));
      return motor_->answer(request, origin);
    case ControlCommand::battery_full:
    case ControlCommand::battery_set: return answer_battery(request);
    case ControlCommand::device_command:
    case ControlCommand::device_commands: return answer_device(request);
    case ControlCommand::status: break;
  }
  return answer_status();
}

std::string Daemon::answer_status() const {
  std::string out = "{\"ok\":true,\"summary\":";
  append_quoted(out, summary());
  out += ",\"health\":[";
  const auto lines = health(ports::monotonic_ns());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > 0) out += ',';
    out += lines[i];
    out += '}';
  }
  out += "]}\n";
  return out;
}

// Commands of the log: start, stop, what it contains, and what downloads ask for.
ControlAnswer Daemon::answer_log(const ControlRequest& request) {
  switch (request.command) {
    case ControlCommand::log_list:
    case ControlCommand::log_read:
    case ControlCommand::log_sum:
      // Also while nothing is logged: the files of earlier runs are there.
      return ControlAnswer(
          [folder = settings_.log.directory, request] { return answer_from_disk(folder, request); });
    default: break;
  }
  if (!log_.enabled()) return control_error("the log is disabled (log.enabled)");
  if (request.command == ControlCommand::log_select) return answer_log_select(request);
  if (request.command == ControlCommand::log_start) start_log();
  if (request.command == ControlCommand::log_stop) stop_log();
  if (request.command == ControlCommand::log_rotate) {
    if (log_.is_stopped()) return control_error("the log is stopped (log.start)");
    rotate_log();
  }
  return std::string("{\"ok\":true}\n");
}

void Daemon::start_log() {
  if (!log_.is_stopped()) return;
  const std::int64_t now_ns = ports::monotonic_ns();
  pipeline_.advance(now_ns, *this);  // the new file begins with the calibrators as they are then
  log_.start(now_ns);
  event(now_ns, "info", "log.start", "", "on request");
  report_health(now_ns);
}

void Daemon::stop_log() {
  if (log_.is_stopped()) return;
  const std::int64_t now_ns = ports::monotonic_ns();
  pipeline_.advance(now_ns, *this);
  event(now_ns, "info", "log.stop", "", "on request");
  log_.stop(now_ns);
  report_health(now_ns);
}

std::string Daemon::answer_log_select(const ControlRequest& request) {
  if (request.leave_out) {
    if (const auto problem = config::problem_with_choice(*request.leave_out, settings_.ports))
      return control_error(*problem);
    log_.leave_out(*request.leave_out);
    event(ports::monotonic_ns(), "info", "log.left_out", "", words_for_choice(log_.left_out()));
  }
  std::string out = "{\"ok\":true,\"leave_out\":[";
  append_quoted_list(out, log_.left_out());
  return out + "]}\n";
}

// The operator's commands to instruments: which there are, and what became of the newest one.
namespace {

void append_given(std::string& out, const std::optional<PortSession::GivenCommand>& given) {
  if (!given) {
    out += "null";
    return;
  }
  out += "{\"name\":";
  append_quoted(out, given->name);
  const bool over = given->outcome.has_value();
  const std::string_view state = !over ? "under way" : given->outcome->done ? "done" : "failed";
  out += fmt::format(R"(,"number":{},"state":"{}","answer":)", given->number, state);
  if (over) {
    append_quoted(out, given->outcome->text);
  } else {
    out += "null";
  }
  out += '}';
}

void append_commands(std::string& out, const PortSession& session) {
  out += "{\"port\":";
  append_quoted(out, session.settings().name);
  out += ",\"commands\":[";
  std::string_view between;
  for (const auto& command : instruments::device_commands(session.settings().protocol)) {
    out += between;
    out += "{\"name\":";
    append_quoted(out, command.name);
    out += ",\"meaning\":";
    append_quoted(out, command.meaning);
    out += fmt::format(",\"force\":{}}}", command.needs_force);
    between = ",";
  }
  out += "],\"last\":";
  append_given(out, session.given_command());
  out += '}';
}

}  // namespace

std::string Daemon::answer_device(const ControlRequest& request) {
  const auto port = device_named(request.port);
  const bool one = !request.port.empty();
  if (one && (!port || *port >= device_count()))
    return control_error(fmt::format("there is no port {}", request.port));
  if (request.command == ControlCommand::device_command) {
    PortSession& session = *sessions_[*port];
    const std::string why_not = session.command_device(request.name, request.force, ports::monotonic_ns());
    if (!why_not.empty()) return control_error(why_not);
    return fmt::format("{{\"ok\":true,\"number\":{}}}\n", session.given_command()->number);
  }
  std::string out = "{\"ok\":true,\"ports\":[";
  std::string_view between;
  for (std::uint16_t i = 0; i < device_count(); ++i) {
    if (one && i != *port) continue;
    out += between;
    append_commands(out, *sessions_[i]);
    between = ",";
  }
  return out + "]}\n";
}

// The calibration that a compass makes of itself (TCM2, PNI): begun and ended by the operator, its score beside
// ours.
namespace {

std::string compass_json(const instruments::CompassCalibration& calibration) {
  std::string out = "{\"state\":";
  append_quoted(out, calibration.state());
  out += ",\"score\":";
  const auto figures = calibration.figures();
  if (figures.empty()) return out + "null}";
  char before = '{';
  for (const auto& figure : figures) {
    fmt::format_to(std::back_inserter(out), "{}\"{}\":{}", before, figure.name, figure.value);
    before = ',';
  }
  return out + "}}";
}

}  // namespace

PortSession* Daemon::compass_named(std::string_view name) const {
  for (const auto& session : sessions_) {
    const auto* const calibration = session->compass_calibration();
    if (calibration != nullptr && calibration->name() == name) return session.get();
  }
  return nullptr;
}

std::string Daemon::answer_compass(const ControlRequest& request) {
  PortSession* const compass = compass_named(request.calibrator);
  if (compass == nullptr) {
    return control_error(request.calibrator == "tcm2" ? std::string("the configuration has no TCM2")
                                                      : "the configuration has no compass " + request.calibrator);
  }
  const std::int64_t now_ns = ports::monotonic_ns();
  std::string why_not = "the compass applies its calibration itself: there is nothing to roll back";
  if (request.command == ControlCommand::calibration_start) why_not = compass->calibrate_compass(now_ns);
  if (request.command == ControlCommand::calibration_stop) why_not = compass->stop_calibrating_compass(now_ns);
  if (request.command == ControlCommand::calibration_accept) why_not = compass->save_compass_calibration(now_ns);
  if (!why_not.empty()) return control_error(why_not);
  return fmt::format("{{\"ok\":true,\"{}\":{}}}\n", request.calibrator,
                     compass_json(*compass->compass_calibration()));
}

void Daemon::turn_compasses(double yaw_rate_rad_s, std::int64_t now_ns) {
  for (const auto& session : sessions_) session->on_yaw_rate(yaw_rate_rad_s, now_ns);
}

std::string Daemon::compasses_json() const {
  std::string members;
  for (const auto& session : sessions_) {
    const auto* const calibration = session->compass_calibration();
    if (calibration == nullptr || session.get() != compass_named(calibration->name())) continue;
    fmt::format_to(std::back_inserter(members), "{}\"{}\":{}", members.empty() ? "" : ",", calibration->name(),
                   compass_json(*calibration));
  }
  return members;
}

void Daemon::on_compass_calibrated(std::uint16_t port, std::int64_t now_ns,
                                   const instruments::CompassCalibration& calibration) {
  on_port_event(port, now_ns, calibration.failure().empty() ? "info" : "warning",
                fmt::format("{}.calibration", calibration.name()), calibration.state());
  if (!calibration.touched()) return;
  // The compass now corrects its field and heading otherwise, so earlier estimates describe a different
  // compass.
  for (const auto calibrator : calib::calibrators()) {
    if (!calib::row_of(calibrator).of_compass) continue;
    pipeline_.order_calibration(pipeline::CalibrationOrder::start, calibrator, now_ns, *this);
  }
  event(now_ns, "warning", "calibration.notice", settings_.ports[port].name,
        "the compass has a new internal correction: its active calibration was made for the old one, and its "
        "calibrators begin anew");
}

}  // namespace navcal::daemon

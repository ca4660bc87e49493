// SPDX-License-Identifier: Apache-2.0
// What the daemon answers on its two sockets.

#include "daemon/daemon.h"
#include "daemon/gpsd_replies.h"
#include "daemon/json_text.h"

namespace navcal::daemon {
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

}  // namespace navcal::daemon

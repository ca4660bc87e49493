// SPDX-License-Identifier: Apache-2.0
// The calibration that a compass makes of itself (TCM2, PNI): begun and ended by the operator, its score beside
// ours.
#include <fmt/format.h>

#include "daemon/daemon.h"
#include "daemon/json_text.h"

namespace navcal::daemon {
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

// SPDX-License-Identifier: Apache-2.0
// The TCM2's calibration of itself: begun and ended by the operator, its score beside ours.
#include <fmt/format.h>

#include "daemon/daemon.h"
#include "daemon/json_text.h"

namespace navcal::daemon {

PortSession* Daemon::tcm2() const {
  for (const auto& session : sessions_) {
    if (session->compass_calibration() != nullptr) return session.get();
  }
  return nullptr;
}

std::string Daemon::answer_tcm2(const ControlRequest& request) {
  PortSession* const compass = tcm2();
  if (compass == nullptr) return control_error("the configuration has no TCM2");
  const std::int64_t now_ns = ports::monotonic_ns();
  std::string why_not = "the TCM2 applies its calibration itself: there is nothing to accept or to roll back";
  if (request.command == ControlCommand::calibration_start) why_not = compass->calibrate_compass(now_ns);
  if (request.command == ControlCommand::calibration_stop) why_not = compass->stop_calibrating_compass(now_ns);
  if (!why_not.empty()) return control_error(why_not);
  return "{\"ok\":true,\"tcm2\":" + tcm2_json() + "}\n";
}

std::string Daemon::tcm2_json() const {
  const PortSession* const compass = tcm2();
  if (compass == nullptr) return {};
  const auto& calibration = *compass->compass_calibration();
  std::string out = "{\"state\":";
  append_quoted(out, calibration.state());
  out += ",\"score\":";
  if (const auto& score = calibration.score()) {
    out += fmt::format("{{\"horizontal\":{},\"vertical\":{},\"magnitude\":{}}}", score->horizontal,
                       score->vertical, score->magnitude);
  } else {
    out += "null";
  }
  return out + "}";
}

void Daemon::on_compass_calibrated(std::uint16_t port, std::int64_t now_ns,
                                   const instruments::Tcm2Calibration& calibration) {
  on_port_event(port, now_ns, calibration.failure().empty() ? "info" : "warning", "tcm2.calibration",
                calibration.state());
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

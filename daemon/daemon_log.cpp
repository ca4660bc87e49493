// SPDX-License-Identifier: Apache-2.0
// Commands of the log: start, stop, what it contains, and what downloads ask for.
#include "daemon/daemon.h"
#include "daemon/health.h"
#include "daemon/json_text.h"
#include "daemon/log_answers.h"

namespace navcal::daemon {

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

}  // namespace navcal::daemon

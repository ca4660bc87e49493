// SPDX-License-Identifier: Apache-2.0
// The operator's commands to instruments: which there are, and what became of the newest one.
#include <fmt/format.h>

#include "daemon/daemon.h"
#include "daemon/json_text.h"

namespace navcal::daemon {
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

}  // namespace navcal::daemon

// SPDX-License-Identifier: Apache-2.0
#include "daemon/control_request.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "daemon/json_text.h"

namespace navcal::daemon {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::pair<std::string_view, ControlCommand>, 10> kCommands{{
    {"event", ControlCommand::event},
    {"log.rotate", ControlCommand::log_rotate},
    {"calibration.start", ControlCommand::calibration_start},
    {"calibration.accept", ControlCommand::calibration_accept},
    {"calibration.rollback", ControlCommand::calibration_rollback},
    {"calibration.stop", ControlCommand::calibration_stop},
    {"motor.lease", ControlCommand::motor_lease},
    {"motor.order", ControlCommand::motor_order},
    {"motor.release", ControlCommand::motor_release},
    {"status", ControlCommand::status},
}};

std::string known_commands() {
  std::string names;
  for (const auto& [name, command] : kCommands) {
    if (!names.empty()) names += ", ";
    names += name;
  }
  return names;
}

std::optional<ControlCommand> command_named(const std::string& text) {
  for (const auto& [name, command] : kCommands) {
    if (text == name) return command;
  }
  return std::nullopt;
}

/// The string at `key`; empty when it is not there, nullopt when it is something else.
std::optional<std::string> text_at(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return std::string();
  if (!found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

/// The number at `key` replaces `value`, where it is there. False when it is something else.
bool take_number(const Json& object, const char* key, double& value) {
  const auto found = object.find(key);
  if (found == object.end()) return true;
  if (!found->is_number()) return false;
  value = found->get<double>();
  return true;
}

/// Each of these: what is wrong with the request, for people; empty: taken.
std::string take_lease(const Json& object, ControlRequest& request) {
  auto& lease = request.lease_request;
  const auto holder = text_at(object, "holder");
  if (!holder || holder->empty()) return "motor.lease needs a holder, a name";
  lease.holder = *holder;
  lease.priority = 1;
  if (const auto priority = object.find("priority"); priority != object.end()) {
    if (!priority->is_number_integer()) return "priority is a whole number";
    const auto wide = priority->get<std::int64_t>();
    // Clamping keeps a value that is out of bounds out of bounds, so that it is refused later.
    lease.priority = static_cast<int>(std::clamp<std::int64_t>(wide, -1, control::kMaxPriority + 1));
  }
  lease.timeout_s = 1;
  return take_number(object, "timeout_s", lease.timeout_s) ? "" : "timeout_s is a number of seconds";
}

std::string take_token(const Json& object, ControlRequest& request) {
  const auto lease = text_at(object, "lease");
  if (!lease || lease->empty()) return "lease is what motor.lease answered";
  request.lease = *lease;
  return {};
}

std::string take_order(const Json& object, ControlRequest& request) {
  if (auto problem = take_token(object, request); !problem.empty()) return problem;
  if (!object.contains("shaft_rpm") || !take_number(object, "shaft_rpm", request.order.shaft_rpm))
    return "shaft_rpm is a number";
  const auto fins = object.find("fins_deg");
  if (fins == object.end() || !fins->is_array() || fins->size() != request.order.fins_deg.size())
    return "fins_deg is three numbers";
  for (std::size_t i = 0; i < request.order.fins_deg.size(); ++i) {
    if (!(*fins)[i].is_number()) return "fins_deg is three numbers";
    request.order.fins_deg[i] = (*fins)[i].get<double>();
  }
  double state_time_utc_s = 0;
  if (!take_number(object, "state_time", state_time_utc_s)) return "state_time is the time of a STATE, a number";
  if (object.contains("state_time")) request.state_time_utc_s = state_time_utc_s;
  return {};
}

std::string take_motor(const Json& object, ControlRequest& request) {
  switch (request.command) {
    case ControlCommand::motor_lease:
      return take_lease(object, request);
    case ControlCommand::motor_order:
      return take_order(object, request);
    case ControlCommand::motor_release:
      return take_token(object, request);
    default:
      return {};
  }
}

}  // namespace

std::variant<ControlRequest, std::string> parse_control(std::string_view line) {
  const Json object = Json::parse(line, nullptr, false);
  if (!object.is_object()) return "not a JSON object; for example {\"command\":\"status\"}";
  const auto name = text_at(object, "command");
  const auto command = name ? command_named(*name) : std::nullopt;
  if (!command) return "unknown command; known are " + known_commands();
  const auto text = text_at(object, "text");
  const auto calibrator = text_at(object, "calibrator");
  if (!text || !calibrator) return "text and calibrator are strings";
  const auto force = object.find("force");
  if (force != object.end() && !force->is_boolean()) return "force is true or false";
  if (*command == ControlCommand::event && text->empty()) return "an event needs a text";
  ControlRequest request;
  request.command = *command;
  request.text = *text;
  request.calibrator = *calibrator;
  request.force = force != object.end() && force->get<bool>();
  if (auto problem = take_motor(object, request); !problem.empty()) return problem;
  return request;
}

std::string control_error(std::string_view message) {
  std::string out = R"({"ok":false,"error":)";
  append_quoted(out, message);
  out += "}\n";
  return out;
}

}  // namespace navcal::daemon

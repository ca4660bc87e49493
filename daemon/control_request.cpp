// SPDX-License-Identifier: Apache-2.0
#include "daemon/control_request.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "daemon/json_text.h"
#include "record/log/log_shelf.h"

namespace navcal::daemon {
namespace {

using Json = nlohmann::json;

/// In the order of ControlCommand.
constexpr std::string_view kCommands =
    "event, log.rotate, log.start, log.stop, log.select, log.list, log.read, log.sum, power.on, power.off, "
    "power.list, calibration.start, calibration.accept, calibration.rollback, calibration.stop, motor.lease, "
    "motor.order, motor.release, motor.stop, battery.full, battery.set, device.command, device.commands, status";

std::optional<ControlCommand> command_named(std::string_view name) {
  int number = 0;
  for (std::string_view rest = kCommands; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find(", "), rest.size());
    if (rest.substr(0, end) == name) return static_cast<ControlCommand>(number);
    rest.remove_prefix(std::min(end + 2, rest.size()));
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

/// The string at `key`. False unless it has a character or more.
bool take_text(const Json& object, const char* key, std::string& text) {
  text = text_at(object, key).value_or("");
  return !text.empty();
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
  if (!take_text(object, "holder", lease.holder)) return "motor.lease needs a holder, a name";
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
  return take_text(object, "lease", request.lease) ? "" : "lease is what motor.lease answered";
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

/// The whole number at `key`, from `low` to `high`; false when it is missing or something else.
bool take_whole(const Json& object, const char* key, std::uint64_t low, std::uint64_t high, std::uint64_t& value) {
  const auto found = object.find(key);
  // A negative number is no unsigned one, and 1e3 is none that is whole by its form.
  if (found == object.end() || !found->is_number_unsigned()) return false;
  value = found->get<std::uint64_t>();
  return value >= low && value <= high;
}

std::string take_part(const Json& object, ControlRequest& request) {
  if (!take_text(object, "file", request.file)) return "file is the name of a log";
  if (!take_whole(object, "offset", 0, INT64_MAX, request.offset)) return "offset is a number of bytes";
  const bool is_sum = request.command == ControlCommand::log_sum;
  const std::uint64_t most_bytes = is_sum ? record::kMaxSum_bytes : record::kMaxPart_bytes;
  if (!take_whole(object, "length", 1, most_bytes, request.length))
    return "length is 1 to " + std::to_string(most_bytes) + " bytes";
  return {};
}

std::string take_page(const Json& object, ControlRequest& request) {
  const auto after = text_at(object, "after");
  if (!after || (!after->empty() && !record::is_log_name(*after))) return "after is the name of a log";
  request.file = *after;
  request.length = record::kMaxPage;
  if (object.contains("limit") && !take_whole(object, "limit", 1, record::kMaxPage, request.length))
    return "limit is 1 to " + std::to_string(record::kMaxPage) + " logs";
  return {};
}

std::string take_choice(const Json& object, ControlRequest& request) {
  const auto found = object.find("leave_out");
  if (found == object.end()) return {};
  request.leave_out.emplace();
  constexpr const char* kWanted = "leave_out is a list of texts";
  if (!found->is_array()) return kWanted;
  for (const auto& choice : *found) {
    if (!choice.is_string()) return kWanted;
    request.leave_out->push_back(choice.get<std::string>());
  }
  return {};
}

std::string take_supply(const Json& object, ControlRequest& request) {
  return take_text(object, "name", request.name) ? "" : "name is that of a supply; power.list has them";
}

std::string take_device(const Json& object, ControlRequest& request) {
  const auto port = text_at(object, "port");
  const auto name = text_at(object, "name");
  const bool lists = request.command == ControlCommand::device_commands;
  if (!port || (port->empty() && !lists)) return "port is the name of a port";
  if (!name || (name->empty() && !lists)) return "name is that of a command; device.commands has them";
  request.port = *port;
  request.name = *name;
  return {};
}

std::string take_charge(const Json& object, ControlRequest& request) {
  double charge_Ah = 0;
  double std_Ah = 0;
  if (!object.contains("charge_Ah") || !take_number(object, "charge_Ah", charge_Ah))
    return "charge_Ah is a number";
  if (!take_number(object, "charge_std_Ah", std_Ah)) return "charge_std_Ah is a number";
  request.charge_Ah = charge_Ah;
  if (object.contains("charge_std_Ah")) request.charge_std_Ah = std_Ah;
  return {};
}

/// What a command has beside the keys that every command may have.
std::string take_own(const Json& object, ControlRequest& request) {
  switch (request.command) {
    case ControlCommand::log_list: return take_page(object, request);
    case ControlCommand::log_read:
    case ControlCommand::log_sum: return take_part(object, request);
    case ControlCommand::log_select: return take_choice(object, request);
    case ControlCommand::power_on:
    case ControlCommand::power_off: return take_supply(object, request);
    case ControlCommand::motor_lease: return take_lease(object, request);
    case ControlCommand::motor_order: return take_order(object, request);
    case ControlCommand::motor_release: return take_token(object, request);
    case ControlCommand::motor_stop:
      // Nothing that is wrong with a name may keep the shaft turning.
      request.by = text_at(object, "by").value_or("").substr(0, control::kMaxHolderLength);
      if (request.by.empty()) request.by = "somebody";
      return {};
    case ControlCommand::battery_set: return take_charge(object, request);
    case ControlCommand::device_command:
    case ControlCommand::device_commands: return take_device(object, request);
    default: return {};
  }
}

}  // namespace

std::variant<ControlRequest, std::string> parse_control(std::string_view line) {
  const Json object = Json::parse(line, nullptr, false);
  if (!object.is_object()) return "not a JSON object; for example {\"command\":\"status\"}";
  const auto name = text_at(object, "command");
  const auto command = name ? command_named(*name) : std::nullopt;
  if (!command) return "unknown command; known are " + std::string(kCommands);
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
  if (auto problem = take_own(object, request); !problem.empty()) return problem;
  return request;
}

std::string control_error(std::string_view message) {
  std::string out = R"({"ok":false,"error":)";
  append_quoted(out, message);
  out += "}\n";
  return out;
}

}  // namespace navcal::daemon

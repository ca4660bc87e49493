// SPDX-License-Identifier: Apache-2.0
#include "daemon/control_request.h"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "daemon/json_text.h"

namespace navcal::daemon {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::pair<std::string_view, ControlCommand>, 7> kCommands{{
    {"event", ControlCommand::event},
    {"log.rotate", ControlCommand::log_rotate},
    {"calibration.start", ControlCommand::calibration_start},
    {"calibration.accept", ControlCommand::calibration_accept},
    {"calibration.rollback", ControlCommand::calibration_rollback},
    {"calibration.stop", ControlCommand::calibration_stop},
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
  return ControlRequest{*command, *text, *calibrator, force != object.end() && force->get<bool>()};
}

std::string control_error(std::string_view message) {
  std::string out = R"({"ok":false,"error":)";
  append_quoted(out, message);
  out += "}\n";
  return out;
}

}  // namespace navcal::daemon

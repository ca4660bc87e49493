// SPDX-License-Identifier: Apache-2.0
// Commands of the operator to the device at a port.
#include <fmt/format.h>

#include <algorithm>

#include "daemon/port_session.h"
#include "protocols/device_types.h"

namespace navcal::daemon {

std::string PortSession::why_no_command(std::string_view name, bool force) const {
  const auto known = instruments::device_commands(settings_.protocol);
  if (known.empty())
    return fmt::format("a device of protocol {} takes no commands", protocols::name_of(settings_.protocol));
  const auto found = std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.name == name; });
  if (found == known.end()) {
    std::string names;
    for (const auto& one : known) names.append(names.empty() ? "" : ", ").append(one.name);
    return fmt::format("{} has no command {}; it has {}", settings_.name, name, names);
  }
  if (!open_port()) return "the device is away: " + reason_;
  if (command_) return given_command_->name + " is under way";
  if (calibrating_compass_) return "the compass calibrates itself: " + compass_calibration_->state();
  if (start_up_ && !start_up_->in_service()) return "the start-up dialogue is under way: " + start_up_->state();
  if (found->needs_force && !force) return fmt::format("{} {}; it needs force", name, found->meaning);
  return {};
}

std::string PortSession::command_device(std::string_view name, bool force, std::int64_t now_ns) {
  if (auto why_not = why_no_command(name, force); !why_not.empty()) return why_not;
  const std::uint64_t number = given_command_ ? given_command_->number + 1 : 1;
  given_command_ = GivenCommand{std::string(name), number, std::nullopt};
  command_ = instruments::make_device_command(settings_, name, now_ns);
  owner_.on_port_event(index_, now_ns, "info", "device.command", fmt::format("{}: given by the operator", name));
  talk(now_ns);
  return {};
}

bool PortSession::talk_of_command(std::int64_t now_ns) {
  if (!command_) return false;
  while (const auto bytes = command_->next(now_ns)) port_.send(*bytes);
  if (!command_->outcome()) {
    talk_timer_.arm(command_->deadline_ns());
    return true;
  }
  end_command(now_ns, *command_->outcome());
  return false;
}

void PortSession::end_command(std::int64_t now_ns, instruments::DeviceCommand::Outcome outcome) {
  command_.reset();
  const bool done = outcome.done;
  const std::string said = fmt::format("{}: {}{}", given_command_->name, done ? "" : "failed: ", outcome.text);
  given_command_->outcome = std::move(outcome);
  owner_.on_port_event(index_, now_ns, done ? "info" : "warning", "device.command", said);
}

}  // namespace navcal::daemon

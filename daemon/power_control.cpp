// SPDX-License-Identifier: Apache-2.0
#include "daemon/power_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "daemon/json_text.h"

namespace navcal::daemon {

PowerControl::PowerControl(const boost::asio::any_io_executor& executor, const config::Settings& settings,
                           const Sessions& sessions, PowerOwner& owner, OpenLine open)
    : sessions_(sessions), owner_(owner), open_(std::move(open)), timer_(executor, [this] { ring(); }) {
  for (const auto& power : settings.power) {
    Supply& supply = supplies_.emplace_back();
    supply.settings = power;
    for (std::size_t port = 0; port < settings.ports.size(); ++port) {
      const auto& fed = power.devices;
      if (std::find(fed.begin(), fed.end(), settings.ports[port].name) != fed.end())
        supply.ports.push_back(static_cast<std::uint16_t>(port));
    }
  }
}

void PowerControl::begin(std::int64_t now_ns) {
  for (Supply& supply : supplies_) {
    if (!take(supply, now_ns))
      owner_.on_power_event(now_ns, "error", "power.failed", supply.settings.name + ": " + supply.problem);
  }
}

bool PowerControl::take(Supply& supply, std::int64_t now_ns) {
  supply.line = open_(supply.settings, supply.problem);
  if (!supply.line) return false;
  supply.problem.clear();
  const auto on = supply.line->is_on();
  const bool leave = supply.settings.at_start == config::PowerAtStart::leave;
  if (on == false) cut(supply, now_ns, "off since navcald took the line");
  if (on == true && !leave) settle(supply, now_ns);
  return true;
}

std::string PowerControl::answer(const ControlRequest& request) {
  if (request.command == ControlCommand::power_list) return list();
  const auto supply = std::find_if(supplies_.begin(), supplies_.end(),
                                   [&](const Supply& known) { return known.settings.name == request.name; });
  if (supply == supplies_.end())
    return control_error(fmt::format("there is no supply {}; power.list has them", request.name));
  const bool on = request.command == ControlCommand::power_on;
  const std::string problem = switch_to(*supply, on, ports::monotonic_ns());
  return problem.empty() ? fmt::format("{{\"ok\":true,\"on\":{}}}\n", on) : control_error(problem);
}

std::string PowerControl::switch_to(Supply& supply, bool on, std::int64_t now_ns) {
  const auto& name = supply.settings.name;
  for (const std::uint16_t port : on ? std::vector<std::uint16_t>() : supply.ports) {
    if (auto why = owner_.why_power_stays(port); !why.empty()) return why;
  }
  if (!supply.line && !take(supply, now_ns)) return supply.problem;
  if (supply.line->is_on() == on) return {};
  supply.problem = supply.line->set(on);
  if (!supply.problem.empty()) {
    owner_.on_power_event(now_ns, "error", "power.failed", name + ": " + supply.problem);
    return supply.problem;
  }
  owner_.on_power_event(now_ns, "info", on ? "power.on" : "power.off",
                        fmt::format("{}: {}", name, fmt::join(supply.settings.devices, ", ")));
  if (on) {
    settle(supply, now_ns);
  } else {
    supply.ready_ns = LazyTimer::kNever;
    cut(supply, now_ns, "switched off by power.off " + name);
  }
  return {};
}

void PowerControl::settle(Supply& supply, std::int64_t now_ns) {
  cut(supply, now_ns, fmt::format("switched on, settles for {} s", supply.settings.settle_s));
  supply.ready_ns = now_ns + static_cast<std::int64_t>(supply.settings.settle_s * 1e9);
  timer_.arm(supply.ready_ns);
}

void PowerControl::cut(const Supply& supply, std::int64_t now_ns, const std::string& reason) const {
  for (const std::uint16_t port : supply.ports) sessions_[port]->power_off(now_ns, reason);
}

void PowerControl::ring() {
  const std::int64_t now_ns = ports::monotonic_ns();
  std::int64_t next_ns = LazyTimer::kNever;
  for (Supply& supply : supplies_) {
    if (now_ns >= supply.ready_ns) {
      supply.ready_ns = LazyTimer::kNever;
      for (const std::uint16_t port : supply.ports) sessions_[port]->power_on(now_ns);
    }
    next_ns = std::min(next_ns, supply.ready_ns);
  }
  timer_.arm(next_ns);
}

std::string PowerControl::list() const {
  std::string out = "{\"ok\":true,\"supplies\":[";
  for (const Supply& supply : supplies_) {
    if (&supply != &supplies_.front()) out += ',';
    const auto on = supply.line ? supply.line->is_on() : std::nullopt;
    out += "{\"name\":";
    append_quoted(out, supply.settings.name);
    out += fmt::format(",\"on\":{},\"settled\":{},\"devices\":[", on ? *on ? "true" : "false" : "null",
                       supply.ready_ns == LazyTimer::kNever);
    append_quoted_list(out, supply.settings.devices);
    out += "],\"problem\":";
    append_quoted(out, supply.problem);
    out += '}';
  }
  return out + "]}\n";
}

}  // namespace navcal::daemon

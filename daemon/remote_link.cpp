// SPDX-License-Identifier: Apache-2.0
#include "daemon/remote_link.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/enum_name.h"
#include "daemon/json_text.h"
#include "daemon/start_error.h"

namespace navcal::daemon {
namespace {

/// Numbers of the control socket's connections stay below this.
constexpr std::uint64_t kFirstRemoteClient = std::uint64_t{1} << 63;

constexpr std::int64_t kBeat_ns = 20'000'000;
constexpr std::string_view kReadOnly =
    "the link is read-only: navcald has no key for it (remote.key_file, or remote.orders_without_key)";
/// Commands that change nothing.
constexpr std::array<std::string_view, 3> kHarmless{"status", "log.list", "log.read"};

link::EndOptions end_options(const config::RemoteSettings& settings) {
  link::EndOptions options;
  options.budget_B_s = settings.budget_B_s;
  options.dead_s = settings.dead_s;
  if (settings.key_file.empty()) return options;
  options.key = link::Key::from_file(settings.key_file);
  return options;
}

bool is_harmless(std::string_view line) {
  const auto request = nlohmann::json::parse(line, nullptr, false);
  if (!request.is_object()) return true;
  const auto command = request.find("command");
  if (command == request.end() || !command->is_string()) return true;
  for (const std::string_view name : kHarmless) {
    if (command->get_ref<const std::string&>() == name) return true;
  }
  return false;
}

ControlRequest request_of(const link::Command& command, const std::string& lease) {
  ControlRequest request;
  request.lease = lease;
  switch (command.kind) {
    case link::Command::Kind::lease:
      request.command = ControlCommand::motor_lease;
      request.lease_request = {command.holder, command.priority, command.timeout_s};
      break;
    case link::Command::Kind::order:
      request.command = ControlCommand::motor_order;
      request.order.shaft_rpm = command.shaft_rpm;
      request.order.fins_deg = command.fins_deg;
      break;
    case link::Command::Kind::release: request.command = ControlCommand::motor_release; break;
    case link::Command::Kind::stop:
      request.command = ControlCommand::motor_stop;
      request.by = command.holder;
      break;
  }
  return request;
}

config::PortSettings line_settings(const config::RemoteSettings& settings) {
  config::PortSettings port;
  port.name = "remote";
  port.path = settings.path;
  port.baud = settings.baud;
  if (settings.path.empty()) port.address = "tcp-listen:" + settings.listen;
  return port;
}

std::string_view name_of(link::Vehicle::Peer peer) {
  return base::enum_name<link::Vehicle::Peer::dead>(peer, {"none", "alive", "dead"});
}

}  // namespace

RemoteLink::RemoteLink(const boost::asio::any_io_executor& executor, const config::RemoteSettings& settings,
                       RemoteOwner& owner)
    : settings_(settings), owner_(owner), has_key_(!settings.key_file.empty()), vehicle_(end_options(settings)),
      line_(executor, line_settings(settings_), listener()),
      timer_(executor, [this] { drive(ports::monotonic_ns()); }), beat_timer_(executor, [this] { beat(); }) {
  const std::string refusal = settings_.path.empty() ? line_.listen() : std::string();
  if (!refusal.empty()) throw StartError(fmt::format("remote.listen {}: {}", settings_.listen, refusal));
}

void RemoteLink::start() {
  line_.start();
  drive(ports::monotonic_ns());
}

void RemoteLink::stop() {
  alive_.reset();
  timer_.stop();
  beat_timer_.stop();
  line_.stop();
}

void RemoteLink::on_opened(std::int64_t now_ns, const ports::OpenPort& port) {
  is_open_ = true;
  owner_.on_remote_event(now_ns, "info", "remote.open", port.path);
}

void RemoteLink::on_lost(std::int64_t now_ns, std::string_view reason) {
  // That nobody has connected yet is no fault.
  if (!std::exchange(is_open_, false) && settings_.path.empty()) return;
  owner_.on_remote_event(now_ns, "warning", "remote.lost", reason);
}

void RemoteLink::on_bytes(std::int64_t now_ns, protocols::Bytes bytes) {
  vehicle_.take(now_ns, bytes);
  drive(now_ns);
}

void RemoteLink::drive(std::int64_t now_ns) {
  vehicle_.advance(now_ns);
  take_events(now_ns);
  if (const auto command = vehicle_.take_command()) execute(*command, now_ns);
  while (!is_answering_) {
    const auto request = vehicle_.take_request();
    if (!request) break;
    answer(*request, now_ns);
  }
  if (vehicle_.is_report_due(now_ns)) vehicle_.report(now_ns, link::encode_report(owner_.remote_report(now_ns)));
  while (const auto frame = vehicle_.next(now_ns)) line_.send(*frame);
  timer_.arm(vehicle_.deadline_ns());
}

void RemoteLink::take_events(std::int64_t now_ns) {
  using Kind = link::Vehicle::Event::Kind;
  for (const auto& event : vehicle_.take_events()) {
    switch (event.kind) {
      case Kind::came:
        owner_.on_remote_event(
            now_ns, "info", "remote.operator",
            has_key_ ? "an operator with the key is on the link" : "an operator is on the link");
        owner_.on_remote_dead(now_ns, false);
        break;
      case Kind::silent: link_is_silent(now_ns); break;
      case Kind::returned:
        owner_.on_remote_event(now_ns, "info", "remote.operator", "the link is back, the session goes on");
        owner_.on_remote_dead(now_ns, false);
        break;
      case Kind::left:
        lease_.clear();
        is_leasing_ = false;
        owner_.remote_client_gone(kFirstRemoteClient + event.session);
        owner_.on_remote_event(now_ns, "info", "remote.operator", "the operator has left the link");
        owner_.on_remote_dead(now_ns, false);
        break;
    }
  }
}

void RemoteLink::link_is_silent(std::int64_t now_ns) {
  std::string words = fmt::format("nothing was heard of the operator for {} s", settings_.dead_s);
  switch (settings_.on_dead) {
    case config::OnDead::release:
      owner_.remote_client_gone(kFirstRemoteClient + vehicle_.session());
      words += "; a lease of the link ends";
      break;
    case config::OnDead::safe:
      owner_.end_every_lease();
      words += "; every lease ends";
      break;
    case config::OnDead::nothing: break;
  }
  owner_.on_remote_event(now_ns, "warning", "remote.dead", words);
  owner_.on_remote_dead(now_ns, true);
}

ControlOrigin RemoteLink::origin(std::int64_t now_ns) const {
  return {kFirstRemoteClient + vehicle_.session(), now_ns, lease_.empty() ? now_ns : beat_before_ns_};
}

void RemoteLink::beat() {
  beat_before_ns_ = std::exchange(last_beat_ns_, ports::monotonic_ns());
  if (!lease_.empty()) beat_timer_.arm(last_beat_ns_ + kBeat_ns);
}

void RemoteLink::execute(const link::Command& command, std::int64_t now_ns) {
  link::CommandAnswer refusal;
  refusal.number = command.number;
  refusal.error = kReadOnly;
  if (!may_change()) return vehicle_.answer(refusal);
  using Kind = link::Command::Kind;
  if (command.kind != Kind::order) is_leasing_ = command.kind == Kind::lease;
  const std::weak_ptr<char> alive = alive_;
  const auto reply = [this, alive, kind = command.kind, number = command.number,
                      session = vehicle_.session()](const std::string& line) {
    if (alive.expired()) return;
    const auto answer = nlohmann::json::parse(line, nullptr, false);
    const bool is_ok = answer.value("ok", false);
    const bool is_same = session == vehicle_.session();
    if (is_ok && kind == Kind::lease) {
      if (is_same && is_leasing_) {
        lease_ = answer.value("lease", "");
        last_beat_ns_ = ports::monotonic_ns();
        beat();
      } else {
        // Released or stopped in the meantime, or its operator has left.
        owner_.remote_client_gone(kFirstRemoteClient + session);
      }
    }
    if (!is_same) return;
    vehicle_.answer({number, is_ok, answer.value("shaped", false), answer.value("error", ""),
                     owner_.is_in_charge(kFirstRemoteClient + session)});
    // Not within drive(), which goes on by itself.
    timer_.arm(0);
  };
  owner_.remote_answer(request_of(command, lease_), origin(now_ns), reply);
}

void RemoteLink::respond(std::string_view response) {
  if (!vehicle_.respond(response)) (void)vehicle_.respond(control_error("the answer is too long for the link"));
}

void RemoteLink::answer(std::string_view line, std::int64_t now_ns) {
  if (!may_change() && !is_harmless(line)) return respond(control_error(kReadOnly));
  const auto parsed = parse_control(line);
  if (const auto* error = std::get_if<std::string>(&parsed)) return respond(control_error(*error));
  is_answering_ = true;
  const std::weak_ptr<char> alive = alive_;
  owner_.remote_answer(std::get<ControlRequest>(parsed), origin(now_ns),
                       [this, alive, session = vehicle_.session()](const std::string& response) {
                         if (alive.expired()) return;
                         is_answering_ = false;
                         // An operator that came in the meantime has not asked for it.
                         if (session == vehicle_.session()) respond(response);
                         // Not within drive(), which goes on by itself.
                         timer_.arm(0);
                       });
}

std::string RemoteLink::health() const {
  const auto& counters = vehicle_.counters();
  std::string out = fmt::format(
      "{{\"operator\":\"{}\",\"sessions\":{},\"open\":{},\"frames\":{},\"bad_checksum\":{},"
      "\"refused\":{},\"repeated\":{},\"sent_bytes\":{},\"loss\":",
      name_of(vehicle_.peer()), vehicle_.session(), is_open_, counters.frames, vehicle_.line().bad_checksum,
      counters.refused, counters.repeated, counters.sent_bytes);
  append_shortest(out, vehicle_.loss(), 3);
  return out + '}';
}

}  // namespace navcal::daemon

// SPDX-License-Identifier: Apache-2.0
#include "daemon/motor_control.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <iterator>
#include <utility>

#include "config/load.h"
#include "daemon/json_text.h"
#include "daemon/motor_note.h"
#include "pipeline/sources.h"
#include "record/json/json_object.h"

namespace navcal::daemon {
namespace {

/// The longest line for the card, `$MCC,-99999,-25.0,-25.0,-25.0*hh<CR><LF>`.
constexpr std::int64_t kMccLine_bytes = 35;
/// Longest time that the end of the program waits for a line to leave.
constexpr std::chrono::milliseconds kLastLine{200};
/// Longest time that a lease waits for its note, and the answer to a stop for the card.
constexpr std::chrono::milliseconds kNote{2000}, kShown{1000};
/// Refusals and events that are recorded each second.
constexpr double kRecords_Hz = 10;

/// 128 bits from the kernel in hexadecimal; empty when it gives none.
std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) return {};
  std::string token;
  for (const unsigned char byte : bytes) fmt::format_to(std::back_inserter(token), FMT_STRING("{:02x}"), byte);
  return token;
}

std::int64_t transit_ns(const config::PortSettings& port) {
  return kMccLine_bytes * 10'000'000'000 / std::max(1, port.baud);
}

std::vector<std::shared_ptr<StateFile>> notes(const config::Settings& settings,
                                              const std::filesystem::path& second) {
  std::vector<std::shared_ptr<StateFile>> made{std::make_shared<StateFile>(settings.log.directory / kMotorNote)};
  if (!second.empty()) made.push_back(std::make_shared<StateFile>(second));
  return made;
}

/// True when the run before left the note, or when nobody can tell.
bool was_left(const StateFile& note) {
  std::error_code error;
  return std::filesystem::exists(note.path(), error) || error;
}

}  // namespace

std::optional<std::uint16_t> motor_port(const config::Settings& settings) {
  if (!settings.command.enabled) return std::nullopt;
  for (const std::uint16_t port : pipeline::candidates(settings, config::Role::shaft)) {
    if (settings.ports[port].protocol == protocols::Protocol::motor_card) return port;
  }
  return std::nullopt;
}

MotorControl::MotorControl(const boost::asio::any_io_executor& executor, const config::Settings& settings,
                           const std::filesystem::path& second_note, PortSession& session, LogWriter& log,
                           const pipeline::Pipeline& pipeline, MotorOwner& owner)
    : session_(session), log_(log), pipeline_(pipeline), owner_(owner), command_(settings.command),
      echo_(settings.command.echo_timeout_s, transit_ns(session.settings())), refusals_(kRecords_Hz),
      events_(kRecords_Hz), configuration_(std::make_shared<const std::string>(config::to_toml(settings))),
      notes_(notes(settings, second_note)), timer_(executor, [this] { ring(); }) {
  is_noted_ = std::any_of(notes_.begin(), notes_.end(), [](const auto& note) { return was_left(*note); });
  if (is_noted_) command_.commanded_before(ports::monotonic_ns());
}

ControlAnswer MotorControl::answer(const ControlRequest& request, const ControlOrigin& origin) {
  if (request.command == ControlCommand::motor_lease) return answer_lease(request, origin);
  if (request.command == ControlCommand::motor_order) return answer_order(request, origin);
  if (request.command == ControlCommand::motor_stop) return answer_stop(request, origin);
  std::string problem = command_.release(origin.arrival_ns, request.lease);
  drive(ports::monotonic_ns());
  return problem.empty() ? "{\"ok\":true}\n" : control_error(problem);
}

ControlAnswer MotorControl::answer_stop(const ControlRequest& request, const ControlOrigin& origin) {
  ++stops_;
  const std::string problem = command_.stop(origin.arrival_ns, request.by);
  drive(ports::monotonic_ns());
  if (!problem.empty()) return control_error(problem);
  auto shown = std::make_shared<std::promise<void>>();
  shown_.push_back(shown);
  return ControlAnswer(
      [shown] { return shown->get_future().wait_for(kShown) == std::future_status::ready ? "true" : "false"; },
      [](const std::string& is_shown) { return "{\"ok\":true,\"shown\":" + is_shown + "}\n"; });
}

ControlAnswer MotorControl::answer_lease(const ControlRequest& request, const ControlOrigin& origin) {
  // Whatever becomes of this run, the next one must know that the card may have an order.
  ++leases_under_way_;
  is_noted_ = true;
  return ControlAnswer(
      [notes = notes_, configuration = configuration_] {
        std::string problem = notes.front()->keep(*configuration, kNote);
        for (std::size_t i = 1; problem.empty() && i < notes.size(); ++i)
          (void)notes[i]->keep(*configuration, kNote);
        return problem;
      },
      [this, wanted = request.lease_request, client = origin.client, stops = stops_](std::string problem) {
        return grant(wanted, client, stops, std::move(problem));
      });
}

std::string MotorControl::grant(const control::LeaseRequest& request, std::uint64_t client, std::uint64_t stops,
                                std::string problem) {
  const std::int64_t now_ns = ports::monotonic_ns();
  --leases_under_way_;
  if (is_unnoted_ != !problem.empty()) owner_.on_motor_unnoted(now_ns, is_unnoted_ = !problem.empty());
  if (!problem.empty()) problem.insert(0, "no order is taken that the next start would not know of: ");
  if (problem.empty() && stops != stops_) problem = "stopped since the lease was asked for";
  const std::string token = random_token();
  if (problem.empty() && token.empty()) problem = "no random numbers for a lease";
  if (problem.empty()) problem = command_.lease(now_ns, request, token, client);
  drive(now_ns);
  if (!problem.empty()) return control_error(problem);
  return fmt::format("{{\"ok\":true,\"lease\":\"{}\",\"timeout_s\":{}}}\n", token, request.timeout_s);
}

std::string MotorControl::answer_order(const ControlRequest& request, const ControlOrigin& origin) {
  if (!session_.open_port()) command_.port_lost(session_.reason());
  if (auto problem = command_.order(origin.arrival_ns, origin.sent_ns, request.lease, request.order);
      !problem.empty())
    return refuse(request, origin, std::move(problem));
  asked_ns_ = origin.arrival_ns;
  late_s_.reset();
  if (request.state_time_utc_s)
    late_s_ = static_cast<double>(pipeline_.mapping().to_utc(asked_ns_)) * 1e-9 - *request.state_time_utc_s;
  const auto sent_ns = drive(ports::monotonic_ns());
  if (!sent_ns) return refuse(request, origin, "the line to the card takes nothing now");
  std::string out = "{\"ok\":true,\"sent\":";
  record::append_seconds(out, pipeline_.mapping().to_utc(*sent_ns));
  out += fmt::format(",\"sequence\":{},\"shaped\":{}}}\n", command_.sequence(), command_.is_shaping());
  return out;
}

std::string MotorControl::refuse(const ControlRequest& request, const ControlOrigin& origin, std::string reason) {
  drive(ports::monotonic_ns());
  ++refused_;
  refusal_ = reason;
  const std::int64_t now_ns = ports::monotonic_ns();
  if (!refusals_.take(now_ns)) {
    ++refused_since_;
    return control_error(reason);
  }
  control::OrderRecord record = record_of_holder();
  record.outcome = control::Outcome::refused;
  record.asked_ns = origin.arrival_ns;
  record.wanted = request.order;
  record.reason = std::move(reason);
  record.refused_since = std::exchange(refused_since_, 0);
  log_.command(now_ns, session_.settings().name, record);
  return control_error(record.reason);
}

control::OrderRecord MotorControl::record_of_holder() const {
  control::OrderRecord record;
  record.sequence = command_.sequence();
  if (const auto& holder = command_.holder()) {
    record.holder = holder->name;
    record.priority = holder->priority;
  }
  return record;
}

void MotorControl::client_gone(std::uint64_t client, std::string reason) {
  const std::int64_t now_ns = ports::monotonic_ns();
  command_.client_gone(now_ns, client, std::move(reason));
  drive(now_ns);
}

void MotorControl::leak(std::int64_t now_ns, std::string leak) {
  command_.leak(now_ns, std::move(leak));
  drive(now_ns);
}

std::string MotorControl::why_power_stays() const {
  const auto& line = command_.last_line();
  const bool is_safe = line && line->source == control::Source::safe;
  if (!command_.holder() || is_safe) return {};
  return fmt::format("{} holds the motor card: release the lease first, which orders the safe state",
                     control::words_for(*command_.holder()));
}

void MotorControl::port_changed(std::int64_t now_ns) {
  const bool is_open = session_.open_port().has_value();
  if (is_open == is_open_) return;
  is_open_ = is_open;
  if (is_open) {
    command_.port_opened(now_ns);
  } else {
    command_.port_lost(session_.reason());
    echo_.give_up(records_);
  }
  drive(now_ns);
}

void MotorControl::status(const instruments::Stamp& stamp, const instruments::MotorSample& motor) {
  if (motor.rpm_commanded) command_.shown(stamp.arrival_ns, *motor.rpm_commanded);
  echo_.status(stamp.validity_ns, stamp.arrival_ns, motor.rpm_commanded, records_);
  drive(ports::monotonic_ns());
}

void MotorControl::begin_stop() {
  const std::int64_t now_ns = ports::monotonic_ns();
  command_.shut_down(now_ns);
  drive(now_ns);
}

void MotorControl::stop() {
  session_.flush(kLastLine);
  stopped_ = true;
  echo_.give_up(records_);
  take_records(ports::monotonic_ns());
  timer_.stop();
  for (const auto& note : notes_) note->stop();
}

std::vector<std::string> MotorControl::take_notices() {
  std::vector<std::string> all;
  for (const auto& note : notes_) {
    for (auto& notice : note->take_notices()) all.push_back(std::move(notice));
  }
  return all;
}

void MotorControl::ring() { drive(ports::monotonic_ns()); }

std::optional<std::int64_t> MotorControl::drive(std::int64_t now_ns) {
  // Connections that close with the program must not set the timer again.
  if (stopped_) return std::nullopt;
  std::optional<std::int64_t> sent_ns;
  while (const auto line = command_.next(now_ns)) {
    if (const auto at_ns = send(*line, now_ns)) sent_ns = at_ns;
  }
  echo_.update(now_ns, records_);
  take_records(now_ns);
  tell(now_ns);
  timer_.arm(std::min(command_.deadline_ns(), echo_.deadline_ns()));
  return sent_ns;
}

std::optional<std::int64_t> MotorControl::send(const control::Line& line, std::int64_t now_ns) {
  const auto sent_ns = session_.send_now(protocols::motor_card::encode_command(line.command));
  if (!sent_ns) {
    if (std::exchange(busy_, true)) return std::nullopt;
    owner_.on_motor_event(now_ns, "warning", "motor.busy", "the line to the card takes nothing now");
    return std::nullopt;
  }
  busy_ = false;
  ++sent_;
  control::OrderRecord record = record_of_holder();
  record.source = line.source;
  if (line.source != control::Source::safe) {
    record.asked_ns = asked_ns_;
    record.late_s = late_s_;
  }
  record.sent_ns = sent_ns;
  record.wanted = command_.wanted();
  record.sent = line.command;
  echo_.sent(std::move(record), records_);
  return sent_ns;
}

void MotorControl::take_records(std::int64_t now_ns) {
  for (const control::OrderRecord& record : records_) {
    log_.command(now_ns, session_.settings().name, record);
    if (record.outcome == control::Outcome::superseded) ++superseded_;
    if (record.outcome == control::Outcome::not_echoed) ++not_echoed_;
    if (record.outcome != control::Outcome::echoed) continue;
    ++echoed_;
    echo_s_ = static_cast<double>(*record.echoed_ns - *record.sent_ns) * 1e-9;
    if (record.source != control::Source::safe) continue;
    command_.safe_echoed();
    for (const auto& shown : std::exchange(shown_, {})) shown->set_value();
  }
  records_.clear();
  const bool is_needed = command_.is_card_commanded() || command_.holder() || leases_under_way_ > 0;
  if (is_needed || !std::exchange(is_noted_, false)) return;
  for (const auto& note : notes_) note->remove();
}

void MotorControl::tell(std::int64_t now_ns) {
  for (auto& event : command_.take_events()) {
    // No client can make leaks: they need no limit, and must not be lost in a flood of leases.
    if (event.name != "motor.leak" && !events_.take(now_ns)) {
      ++events_left_out_;
      continue;
    }
    if (events_left_out_ > 0)
      event.message += fmt::format(" ({} events before this one were left out)", events_left_out_);
    events_left_out_ = 0;
    owner_.on_motor_event(now_ns, event.severity, event.name, event.message);
  }
  if (echo_.is_deaf() == is_deaf_) return;
  is_deaf_ = echo_.is_deaf();
  owner_.on_motor_deaf(now_ns, is_deaf_);
}

std::string MotorControl::health(std::int64_t now_ns) const {
  std::string out = "{\"device\":";
  append_quoted(out, session_.settings().name);
  if (const auto& holder = command_.holder()) {
    out += ",\"holder\":";
    append_quoted(out, holder->name);
    out += fmt::format(",\"priority\":{},\"expires_in_s\":", holder->priority);
    append_shortest(out, static_cast<double>(holder->expires_ns - now_ns) * 1e-9, 3);
  } else {
    out += ",\"holder\":null,\"priority\":null,\"expires_in_s\":null";
  }
  if (const auto& line = command_.last_line()) {
    const auto& fins = line->command.fins_deg;
    out += fmt::format(",\"shaft_rpm\":{},\"fins_deg\":[{},{},{}],\"safe\":{}", line->command.rpm, fins[0],
                       fins[1], fins[2], line->source == control::Source::safe);
  } else {
    out += ",\"shaft_rpm\":null,\"fins_deg\":null,\"safe\":null";
  }
  out += fmt::format(",\"orders\":{},\"refused\":{},\"refusal\":", command_.sequence(), refused_);
  append_quoted(out, refusal_);
  out += fmt::format(",\"sent\":{},\"echoed\":{},\"not_echoed\":{},\"superseded\":{},\"echo_s\":", sent_, echoed_,
                     not_echoed_, superseded_);
  echo_s_ ? append_shortest(out, *echo_s_, 4) : void(out += "null");
  return out + '}';
}

}  // namespace navcal::daemon

// SPDX-License-Identifier: Apache-2.0
#include "daemon/port_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/enum_name.h"

namespace navcal::daemon {
namespace {

/// A device that sends nothing for three of its periods, and for this long, is silent.
constexpr double kSilent_s = 3.0;
constexpr std::uint64_t kUsualUnused = 10;  // one frame of so many

}  // namespace

std::string_view name_of(PortSession::State state) {
  return base::enum_name<PortSession::State::off>(state,
                                                  {"away", "silent", "no_frames", "noisy", "running", "off"});
}

PortSession::PortSession(const boost::asio::any_io_executor& executor, std::uint16_t port,
                         const config::PortSettings& settings, PortOwner& owner)
    : index_(port), settings_(settings), owner_(owner), start_up_(instruments::make_start_up(settings)),
      compass_calibration_(instruments::make_compass_calibration(settings)),
      talk_timer_(executor, [this] { talk(ports::monotonic_ns()); }),
      speed_check_(settings.protocol, settings.baud), port_(executor, settings, *this) {
  if (settings.protocol == protocols::Protocol::oncore && settings.aid) aid_.emplace();
}

void PortSession::stop() {
  talk_timer_.stop();
  port_.stop();
}

void PortSession::on_opened(std::int64_t now_ns, const ports::OpenPort& port) {
  open_ = port;
  opened_ns_ = last_bytes_ns_ = now_ns;
  ++times_opened_;
  opened_anew_ = true;
  owner_.on_port_event(index_, now_ns, "info", "port.opened",
                       fmt::format("{}{}{}{}; low latency: {}", port.path,
                                   port.is_network ? std::string() : fmt::format(" at {} Bd", settings_.baud),
                                   port.description.empty() ? "" : ", ", port.description, port.low_latency));
  if (off_) return;
  set_state(now_ns, State::running, "opened");
  if (start_up_) start_up_->begin(now_ns);
  if (aid_) aid_->begin();
  talk(now_ns);
}

void PortSession::power_off(std::int64_t now_ns, std::string reason) {
  abandon_calibration(now_ns, "the compass was switched off");
  if (command_) end_command(now_ns, {false, "the device was switched off"});
  talk_timer_.stop();
  off_ = true;
  set_state(now_ns, State::off, std::move(reason));
}

void PortSession::power_on(std::int64_t now_ns) {
  off_ = false;
  if (!open_) return set_state(now_ns, State::away, "switched on, not found yet");
  last_bytes_ns_ = now_ns;
  opened_anew_ = true;
  set_state(now_ns, State::running, "switched on");
  if (start_up_) start_up_->begin(now_ns);
  talk(now_ns);
}

void PortSession::on_bytes(std::int64_t arrival_ns, protocols::Bytes bytes) {
  last_bytes_ns_ = arrival_ns;
  owner_.on_port_bytes(index_, arrival_ns, bytes);
  speed_check_.bytes(bytes);
  talk(arrival_ns);
  aid_receiver(arrival_ns);
}

void PortSession::on_sent(std::int64_t now_ns, protocols::Bytes bytes) {
  owner_.on_port_sent(index_, now_ns, bytes);
}

void PortSession::on_lost(std::int64_t now_ns, std::string_view reason) {
  open_.reset();
  talk_timer_.stop();
  abandon_calibration(now_ns, "the compass went away");
  if (command_) end_command(now_ns, {false, "the device went away"});
  // An adapter that is fed by the same supply goes with its device.
  owner_.on_port_event(index_, now_ns, off_ ? "info" : "warning", "port.lost", reason);
  if (!off_) set_state(now_ns, State::away, std::string(reason));
}

void PortSession::abandon_calibration(std::int64_t now_ns, const std::string& reason) {
  if (!calibrating_compass_) return;
  // It is unknown whether the compass still calibrates. The start-up after its return makes it send words again.
  compass_calibration_->abandon(reason);
  end_calibration(now_ns);
}

void PortSession::end_calibration(std::int64_t now_ns) {
  calibrating_compass_ = false;
  if (!std::exchange(saving_calibration_, false)) {
    return owner_.on_compass_calibrated(index_, now_ns, *compass_calibration_);
  }
  owner_.on_port_event(index_, now_ns, compass_calibration_->failure().empty() ? "info" : "warning",
                       fmt::format("{}.calibration", compass_calibration_->name()), compass_calibration_->state());
}

std::string PortSession::save_compass_calibration(std::int64_t now_ns) {
  if (!open_port()) return "the compass is away: " + reason_;
  if (auto why_not = compass_calibration_->save(now_ns); !why_not.empty()) return why_not;
  calibrating_compass_ = saving_calibration_ = true;
  talk(now_ns);
  return {};
}

void PortSession::on_frame(const protocols::Frame& frame, std::int64_t arrival_ns) {
  if (compass_calibration_) compass_calibration_->on_frame(frame, arrival_ns);
  if (start_up_) start_up_->on_frame(frame, arrival_ns);
  if (aid_) aid_->on_frame(frame, arrival_ns);
  if (command_) command_->on_frame(frame, arrival_ns);
}

std::string PortSession::calibrate_compass(std::int64_t now_ns) {
  if (!compass_calibration_) return "the device at this port does not calibrate itself";
  if (!open_port()) return "the compass is away: " + reason_;
  if (calibrating_compass_) return "it is under way: " + compass_calibration_->state();
  if (command_) return given_command_->name + " is under way";
  compass_calibration_->begin(now_ns);
  calibrating_compass_ = true;
  owner_.on_port_event(index_, now_ns, "info", fmt::format("{}.calibration", compass_calibration_->name()),
                       fmt::format("begun: {}", compass_calibration_->manoeuvre()));
  talk(now_ns);
  return {};
}

std::string PortSession::stop_calibrating_compass(std::int64_t now_ns) {
  if (!calibrating_compass_) return "the compass is not calibrating itself";
  compass_calibration_->stop(now_ns);
  talk(now_ns);
  return {};
}

void PortSession::on_yaw_rate(double rate_rad_s, std::int64_t now_ns) {
  if (calibrating_compass_) compass_calibration_->on_yaw_rate(rate_rad_s, now_ns);
}

bool PortSession::talk_of_calibration(std::int64_t now_ns) {
  if (!calibrating_compass_) return false;
  while (const auto bytes = compass_calibration_->next(now_ns)) port_.send(*bytes);
  if (compass_calibration_->busy()) {
    talk_timer_.arm(compass_calibration_->deadline_ns());
    return true;
  }
  end_calibration(now_ns);
  return false;
}

void PortSession::talk(std::int64_t now_ns) {
  if (!open_port() || talk_of_calibration(now_ns) || talk_of_command(now_ns) || !start_up_) return;
  while (const auto bytes = start_up_->next(now_ns)) port_.send(*bytes);
  talk_timer_.arm(start_up_->deadline_ns());
}

void PortSession::aid_receiver(std::int64_t now_ns) {
  if (!open_ || !aid_ || !aid_->wanted()) return;
  const auto aid = owner_.receiver_aid(now_ns);
  if (!aid) return;
  for (const auto& command : aid_->give(*aid)) port_.send(command);
  owner_.on_port_event(index_, now_ns, "info", "receiver.aid",
                       fmt::format("time and position given: {:.5f}, {:.5f}", aid->position.latitude_deg,
                                   aid->position.longitude_deg));
}

void PortSession::tick(std::int64_t now_ns, const pipeline::PortStatistics& statistics) {
  if (opened_anew_) speed_check_.restart(statistics.bytes);
  opened_anew_ = false;
  if (!open_port()) return;
  std::string reason;
  const State state = judge(statistics, now_ns, reason);
  set_state(now_ns, state, std::move(reason));
  if (!start_up_) return;
  if (auto said = start_up_->state(); said != last_start_up_state_) {
    owner_.on_port_event(index_, now_ns, "info", "port.start_up", said);
    last_start_up_state_ = std::move(said);
  }
}

PortSession::State PortSession::judge(const pipeline::PortStatistics& statistics, std::int64_t now_ns,
                                      std::string& reason) {
  const auto verdict = speed_check_.judge(statistics.bytes);
  const double silent_s = static_cast<double>(now_ns - last_bytes_ns_) * 1e-9;
  const double patience_s = std::max(kSilent_s, settings_.rate_Hz > 0 ? 3 / settings_.rate_Hz : 0.0);
  if (silent_s > patience_s) {
    reason = fmt::format("no bytes for {:.0f} s", silent_s);
    return State::silent;
  }
  reason = speed_check_.message();
  switch (verdict) {
    case SpeedCheck::Verdict::wrong_speed:
    case SpeedCheck::Verdict::no_frames: return State::no_frames;
    case SpeedCheck::Verdict::noise: return State::noisy;
    case SpeedCheck::Verdict::good: break;
  }
  // Frames beside the samples are usual with many devices; with NMEA they may be what the port is there for.
  const auto& unused = statistics.unused;
  const bool is_many =
      settings_.protocol == protocols::Protocol::nmea && unused.total() > statistics.bytes.frames / kUsualUnused;
  if (unused.total() > 0 && (statistics.samples == 0 || is_many))
    reason = fmt::format("{} of {} frames give no sample: {} (docs/devices.md)", unused.total(),
                         statistics.bytes.frames, unused.words());
  return State::running;
}

void PortSession::set_state(std::int64_t now_ns, State state, std::string reason) {
  const bool changed = state != state_;
  state_ = state;
  reason_ = std::move(reason);
  if (!changed) return;
  // Loss and return of the port, and of its supply, have been reported already.
  if (state != State::away && state != State::off && reason_ != "opened") {
    const bool good = state == State::running;
    owner_.on_port_event(index_, now_ns, good ? "info" : "warning", "port.state",
                         good ? "running again" : std::string_view(reason_));
  }
  owner_.on_port_changed(index_);
}

}  // namespace navcal::daemon

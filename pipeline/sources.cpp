#include "pipeline/sources.h"

#include <algorithm>

namespace navcal::pipeline {
namespace {

using protocols::Protocol;

Protocol certain_protocol(Role role) {
  switch (role) {
    case Role::heading:
      return Protocol::tcm2;
    case Role::rates:
      return Protocol::imu_card;
    case Role::position:
      return Protocol::oncore;
    case Role::shaft:
      break;
  }
  return Protocol::motor_card;
}

bool nmea_may_say(Role role) { return role == Role::heading || role == Role::position; }

}  // namespace

std::string_view name_of(Role role) {
  constexpr std::array<std::string_view, kRoles.size()> kNames{"heading", "rates", "position", "shaft"};
  return kNames.at(static_cast<std::size_t>(role));
}

std::optional<Role> role_of(const instruments::Sample& sample) {
  if (const auto* compass = std::get_if<instruments::CompassSample>(&sample.value)) {
    if (compass->heading_rad || compass->field_body_uT) return Role::heading;
  } else if (std::holds_alternative<instruments::ImuSample>(sample.value)) {
    return Role::rates;
  } else if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value)) {
    const bool fixed = gps->fix == instruments::Fix::fix_2d || gps->fix == instruments::Fix::fix_3d;
    if (fixed && gps->latitude_rad && gps->longitude_rad) return Role::position;
  } else if (const auto* motor = std::get_if<instruments::MotorSample>(&sample.value)) {
    if (motor->rpm) return Role::shaft;
  }
  return std::nullopt;
}

std::vector<std::uint16_t> candidates(const config::Settings& settings, Role role) {
  std::vector<std::uint16_t> ports;
  const auto add = [&](Protocol protocol) {
    for (std::size_t i = 0; i < settings.ports.size(); ++i) {
      if (settings.ports[i].protocol == protocol) ports.push_back(static_cast<std::uint16_t>(i));
    }
  };
  add(certain_protocol(role));
  if (nmea_may_say(role)) add(Protocol::nmea);
  return ports;
}

CalibratedPorts calibrated_ports(const config::Settings& settings) { return Sources(settings).serving(); }

Sources::Sources(const config::Settings& settings) {
  for (const Role role : kRoles) {
    Service& service = services_[static_cast<std::size_t>(role)];
    service.candidates = candidates(settings, role);
    service.is_certain = !service.candidates.empty() &&
                         settings.ports[service.candidates.front()].protocol == certain_protocol(role);
  }
  begin_run();
}

void Sources::begin_run() {
  for (Service& service : services_) {
    service.newest_ns.assign(service.candidates.size(), std::nullopt);
    service.interval_ns.assign(service.candidates.size(), 0);
    service.began_ns.reset();
    service.server.reset();
    if (!service.candidates.empty()) service.server = 0;
    service.learnt.reset();
    if (service.is_certain || service.candidates.size() == 1) service.learnt = 0;
  }
}

std::optional<Sources::Change> Sources::take(const instruments::Sample& sample) {
  const auto role = role_of(sample);
  if (!role) return std::nullopt;
  Service& service = services_[static_cast<std::size_t>(*role)];
  const auto found = std::find(service.candidates.begin(), service.candidates.end(), sample.port);
  if (found == service.candidates.end()) return std::nullopt;
  const auto place = static_cast<std::size_t>(found - service.candidates.begin());
  const std::int64_t now_ns = sample.stamp.arrival_ns;
  if (!service.began_ns) service.began_ns = now_ns;
  auto& newest_ns = service.newest_ns[place];
  if (newest_ns) service.interval_ns[place] = now_ns - *newest_ns;
  newest_ns = now_ns;
  if (!service.learnt && now_ns - *service.began_ns >= kSilent_ns) {
    const auto delivered = [](const auto& time_ns) { return time_ns.has_value(); };
    const auto best = std::find_if(service.newest_ns.begin(), service.newest_ns.end(), delivered);
    service.learnt = static_cast<std::size_t>(best - service.newest_ns.begin());
  }
  if (place == *service.server) return std::nullopt;

  const auto& server_ns = service.newest_ns[*service.server];
  const bool is_better = place < *service.server;
  // A port of NMEA that has said nothing of the kind so far may never do so.
  const bool server_may_come = server_ns || (service.is_certain && *service.server == 0);
  constexpr std::int64_t kIntervals = 5;
  const std::int64_t patience_ns = std::max(kSilent_ns, kIntervals * service.interval_ns[*service.server]);
  const bool is_silent = now_ns - server_ns.value_or(*service.began_ns) > patience_ns;
  if (!is_better && server_may_come && !is_silent) return std::nullopt;
  Change change{*role, sample.port, service.candidates[*service.server], !is_better && server_may_come};
  if (!server_may_come) change.before.reset();
  service.server = place;
  return change;
}

CalibratedPorts Sources::serving() const {
  const auto of = [&](Role role) {
    const Service& service = services_[static_cast<std::size_t>(role)];
    return service.server ? std::optional(service.candidates[*service.server]) : std::nullopt;
  };
  return {of(Role::heading), of(Role::rates), of(Role::position), of(Role::shaft)};
}

CalibratedPorts Sources::learnt() const {
  const auto of = [&](Role role) {
    const Service& service = services_[static_cast<std::size_t>(role)];
    return service.learnt && !service.candidates.empty() ? std::optional(service.candidates[*service.learnt])
                                                         : std::nullopt;
  };
  return {of(Role::heading), of(Role::rates), of(Role::position), of(Role::shaft)};
}

}  // namespace navcal::pipeline

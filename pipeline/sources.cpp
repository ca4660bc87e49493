// SPDX-License-Identifier: Apache-2.0
#include "pipeline/sources.h"

#include <algorithm>

#include "pipeline/readings.h"
#include "protocols/device_types.h"

namespace navcal::pipeline {
namespace {

/// Share of a new statement in the average of a receiver's dilution of precision.
constexpr double kNewShare = 0.1;
/// Two receivers are compared by so many statements of each.
constexpr std::uint32_t kLeastStatements = 10;
/// So much smaller is the error of a receiver that takes over.
constexpr double kSmaller = 0.7;
/// The one that is preferred by its place comes back unless its error is so much larger.
constexpr double kLarger = 1.2;

RoleSet roles_of(const instruments::CompassSample& compass) {
  RoleSet roles;
  if (compass.heading_rad || compass.heading_calibrated_rad) roles.add(Role::heading);
  if (compass.heading_rad && compass.heading_is_true) roles.add(Role::heading_reference);
  if (compass.field_body_uT) roles.add(Role::field);
  return roles;
}

RoleSet roles_of(const instruments::ImuSample& imu) {
  RoleSet roles;
  if (imu.rate_rad_s) roles.add(Role::rates);
  if (imu.specific_force_m_s2) roles.add(Role::acceleration);
  if (imu.depth_m) roles.add(Role::depth);
  return roles;
}

RoleSet roles_of(const instruments::GpsSample& gps) {
  RoleSet roles;
  if (has_position(gps)) roles.add(Role::position);
  if (ground_velocity_m_s(gps)) roles.add(Role::velocity);
  return roles;
}

RoleSet roles_of(const instruments::MotorSample& motor) {
  return motor.rpm || motor.current_A ? RoleSet{Role::shaft} : RoleSet{};
}

RoleSet roles_of(const instruments::AltimeterSample&) { return {Role::altitude}; }

RoleSet roles_of(const instruments::DvlSample& dvl) {
  RoleSet roles;
  if (dvl.bottom_velocity_m_s) roles.add(Role::bottom_velocity);
  if (dvl.water_velocity_m_s) roles.add(Role::water_velocity);
  if (dvl.altitude_m) roles.add(Role::altitude);
  return roles;
}

RoleSet roles_of(const instruments::DepthSample& gauge) {
  return gauge.depth_m || gauge.pressure_Pa ? RoleSet{Role::depth} : RoleSet{};
}

template <class Other>
RoleSet roles_of(const Other&) {
  return {};
}

std::optional<double> stated_error(const instruments::Sample& sample) {
  const auto* gps = std::get_if<instruments::GpsSample>(&sample.value);
  return gps != nullptr ? gps->dop : std::nullopt;
}

bool is_chosen(const config::Settings& settings, std::uint16_t port, Role role) {
  const std::string& name = settings.roles.chosen_name(role);
  return !name.empty() && settings.ports[port].name == name;
}

/// 0: chosen; 1: its protocol always says it; 2: it may.
int rank(const config::Settings& settings, std::uint16_t port, Role role) {
  if (is_chosen(settings, port, role)) return 0;
  return config::delivers_always(settings.ports[port]) ? 1 : 2;
}

}  // namespace

RoleSet roles_of(const instruments::Sample& sample) {
  return std::visit([](const auto& value) { return roles_of(value); }, sample.value);
}

std::vector<std::uint16_t> candidates(const config::Settings& settings, Role role) {
  std::vector<std::uint16_t> ports;
  for (std::size_t i = 0; i < settings.ports.size(); ++i) {
    const auto port = static_cast<std::uint16_t>(i);
    // No device is a reference by itself: most true headings are those of a magnetometer.
    const bool by_choice =
        role == Role::heading_reference ||
        (role == Role::heading && protocols::device_type(settings.ports[i].protocol).heading_if_chosen);
    const bool may_serve = !by_choice || is_chosen(settings, port, role);
    if (may_serve && config::can_deliver(settings.ports[i], role)) ports.push_back(port);
  }
  std::ranges::stable_sort(
      ports, [&](std::uint16_t a, std::uint16_t b) { return rank(settings, a, role) < rank(settings, b, role); });
  return ports;
}

bool is_certain(const config::Settings& settings, Role role) {
  const auto ports = candidates(settings, role);
  return !ports.empty() && rank(settings, ports.front(), role) < 2;
}

std::vector<std::uint16_t> learnable(const config::Settings& settings, Role role) {
  auto ports = candidates(settings, role);
  if (is_certain(settings, role)) ports.resize(1);
  return ports;
}

Role compass_role(const config::Settings& settings) {
  return candidates(settings, Role::field).empty() ? Role::heading : Role::field;
}

CalibratedPorts calibrated_ports(const config::Settings& settings) {
  const RolePorts first = Sources(settings).serving();
  return {first[compass_role(settings)], first[Role::rates], first[Role::position], first[Role::shaft],
          first[Role::heading_reference]};
}

Sources::Sources(const config::Settings& settings) {
  const Role compass = pipeline::compass_role(settings);
  if (compass == Role::heading || pipeline::is_certain(settings, compass)) compass_role_ = compass;
  for (const Role role : kRoles) {
    Service& service = services_.at(static_cast<std::size_t>(role));
    for (const std::uint16_t port : pipeline::candidates(settings, role)) service.candidates.push_back({port});
    service.is_certain = pipeline::is_certain(settings, role);
    service.is_chosen =
        !service.candidates.empty() && pipeline::is_chosen(settings, service.candidates.front().port, role);
    if (service.is_certain || service.candidates.size() == 1) service.learnt = 0;
  }
  begin_run();
}

void Sources::begin_run() {
  for (Service& service : services_) {
    for (Candidate& candidate : service.candidates) candidate = {candidate.port};
    service.began_ns.reset();
    service.server.reset();
    if (!service.candidates.empty()) service.server = 0;
  }
}

std::vector<Sources::Change> Sources::take(const instruments::Sample& sample) {
  std::vector<Change> changes;
  const RoleSet roles = roles_of(sample);
  if (roles.is_empty()) return changes;
  for (const Role role : kRoles) {
    if (!roles.has(role)) continue;
    if (const auto change = take(services_.at(static_cast<std::size_t>(role)), role, sample))
      changes.push_back(*change);
  }
  if (!compass_role_) choose_compass(sample.stamp.arrival_ns);
  return changes;
}

void Sources::choose_compass(std::int64_t now_ns) {
  const auto& began_ns = service(Role::heading).began_ns;
  if (service(Role::field).began_ns) {
    compass_role_ = Role::field;
  } else if (began_ns && now_ns - *began_ns >= kSilent_ns) {
    compass_role_ = Role::heading;
  }
}

std::optional<Sources::Change> Sources::take(Service& service, Role role, const instruments::Sample& sample) {
  const auto found = std::ranges::find(service.candidates, sample.port, &Candidate::port);
  if (found == service.candidates.end()) return std::nullopt;
  Candidate& candidate = *found;
  const auto place = static_cast<std::size_t>(found - service.candidates.begin());
  const std::int64_t now_ns = sample.stamp.arrival_ns;
  if (!service.began_ns) service.began_ns = now_ns;
  if (candidate.newest_ns) candidate.interval_ns = now_ns - *candidate.newest_ns;
  candidate.newest_ns = now_ns;
  if (const auto error = stated_error(sample)) {
    const double share = candidate.error_statements == 0 ? 1 : kNewShare;
    candidate.error += share * (*error - candidate.error);
    ++candidate.error_statements;
  }
  if (!service.learnt && now_ns - *service.began_ns >= kSilent_ns) {
    const auto best = std::ranges::find_if(service.candidates,
                                           [](const Candidate& other) { return other.newest_ns.has_value(); });
    service.learnt = static_cast<std::size_t>(best - service.candidates.begin());
  }
  if (place == *service.server) return std::nullopt;

  const Candidate& server = service.candidates[*service.server];
  // A port of NMEA that has said nothing of the kind so far may never do so.
  const bool server_may_come = server.newest_ns || (service.is_certain && *service.server == 0);
  constexpr std::int64_t kIntervals = 5;
  const std::int64_t patience_ns = std::max(kSilent_ns, kIntervals * server.interval_ns);
  const bool is_silent = now_ns - server.newest_ns.value_or(*service.began_ns) > patience_ns;
  const bool takes_over = is_better(service, place);
  if (!takes_over && server_may_come && !is_silent) return std::nullopt;
  Change change{role, sample.port, server.port};
  if (!server_may_come) {
    change.before.reset();
  } else if (is_silent) {
    change.cause = Change::Cause::silence;
  } else if (place > *service.server) {
    change.cause = Change::Cause::error;
  }
  service.server = place;
  return change;
}

/// Than the one that serves.
bool Sources::is_better(const Service& service, std::size_t place) {
  const Candidate& mine = service.candidates[place];
  const Candidate& other = service.candidates[*service.server];
  const bool by_error =
      std::min(mine.error_statements, other.error_statements) >= kLeastStatements && !service.is_chosen;
  if (place < *service.server) return !by_error || mine.error < kLarger * other.error;
  return by_error && mine.error < kSmaller * other.error;
}

RolePorts Sources::serving() const {
  RolePorts serving;
  for (std::size_t i = 0; i < services_.size(); ++i) {
    const Service& service = services_.at(i);
    if (service.server) serving.ports.at(i) = service.candidates[*service.server].port;
  }
  return serving;
}

RolePorts Sources::delivering() const {
  RolePorts delivering = serving();
  for (std::size_t i = 0; i < services_.size(); ++i) {
    const Service& service = services_.at(i);
    if (service.server && !service.candidates[*service.server].newest_ns) delivering.ports.at(i).reset();
  }
  return delivering;
}

CalibratedPorts Sources::learnt() const {
  const auto of = [&](Role role) {
    const Service& it = service(role);
    return it.learnt && !it.candidates.empty() ? std::optional(it.candidates[*it.learnt].port) : std::nullopt;
  };
  return {compass_role_ ? of(*compass_role_) : std::nullopt, of(Role::rates), of(Role::position), of(Role::shaft),
          of(Role::heading_reference)};
}

void Sources::go_on_with(const CalibratedPorts& learnt) {
  const auto set = [&](Role role, std::optional<std::uint16_t> port) {
    Service& service = services_.at(static_cast<std::size_t>(role));
    for (std::size_t i = 0; i < service.candidates.size(); ++i) {
      if (port && service.candidates[i].port == *port) service.learnt = i;
    }
  };
  for (const Role role : {Role::field, Role::heading}) {
    if (!compass_role_ || role == *compass_role_) set(role, learnt.compass);
  }
  set(Role::rates, learnt.imu);
  set(Role::position, learnt.gps);
  set(Role::shaft, learnt.motor);
  set(Role::heading_reference, learnt.reference);
}

}  // namespace navcal::pipeline

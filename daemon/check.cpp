#include "daemon/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "instruments/start_up.h"
#include "pipeline/calibration_options.h"
#include "pipeline/sources.h"

namespace navcal::daemon {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;

std::string place(const config::PortSettings& port) {
  if (!port.path.empty()) return port.path;
  if (!port.udev_name.empty()) return fmt::format("udev name {}", port.udev_name);
  return fmt::format("USB adapter with serial number {}", port.usb_serial);
}

/// "compass", or "compass or gps" where the first that delivers serves; empty when there is none.
std::string candidates_of(const config::Settings& settings, pipeline::Role role) {
  std::vector<std::string_view> names;
  for (const std::uint16_t port : pipeline::candidates(settings, role)) names.push_back(settings.ports[port].name);
  return fmt::format("{}", fmt::join(names, " or "));
}

/// The calibrators learn from one instrument: not from NMEA where another protocol always says it.
std::string learnt_of(const config::Settings& settings, pipeline::Role role) {
  const auto ports = pipeline::candidates(settings, role);
  if (ports.empty() || settings.ports[ports.front()].protocol == protocols::Protocol::nmea)
    return candidates_of(settings, role);
  return settings.ports[ports.front()].name;
}

/// Which port may serve what; the first that delivers does.
void append_sources(std::string& out, const config::Settings& settings) {
  std::vector<std::string> roles;
  for (const pipeline::Role role : pipeline::kRoles) {
    if (const std::string ports = candidates_of(settings, role); !ports.empty())
      roles.push_back(fmt::format("{} by {}", pipeline::name_of(role), ports));
  }
  if (!roles.empty()) out += fmt::format("sources: {}\n", fmt::join(roles, ", "));
}

void append_calibration(std::string& out, const config::Settings& settings) {
  const auto ports = pipeline::calibrated_ports(settings);
  if (!settings.calibration.enabled || !ports.compass) {
    out += settings.calibration.enabled ? "calibration: nothing to calibrate\n" : "calibration: off\n";
    return;
  }
  out += fmt::format("calibration: of {}", learnt_of(settings, pipeline::Role::heading));
  for (const auto role : {pipeline::Role::rates, pipeline::Role::position, pipeline::Role::shaft}) {
    if (const std::string learnt = learnt_of(settings, role); !learnt.empty()) out += ", " + learnt;
  }
  if (settings.calibration.automatic) {
    out += fmt::format("; estimates come into force when better by {:.0f} %\n", settings.calibration.margin * 100);
  } else {
    out += "; estimates come into force by calibration.accept\n";
  }
}

}  // namespace

std::string describe(const config::Settings& settings) {
  std::string out;
  const auto line = [&](auto&&... arguments) {
    fmt::format_to(std::back_inserter(out), std::forward<decltype(arguments)>(arguments)...);
    out += '\n';
  };
  for (const auto& port : settings.ports) {
    line(fmt::runtime("port {}: {} at {} Bd, {}{}"), port.name, protocols::name_of(port.protocol), port.baud,
         place(port), instruments::make_start_up(port) ? ", with start-up dialogue" : "");
  }
  if (settings.log.enabled) {
    line(fmt::runtime("log: in {}, synced every {} s, a new file every {} MB or {} h, {} MB kept free"),
         settings.log.directory.string(), settings.log.sync_interval_s, settings.log.rotate_bytes / kMegabyte,
         settings.log.rotate_age_s / 3600, settings.log.free_floor_bytes / kMegabyte);
  } else {
    line(fmt::runtime("log: off"));
  }
  append_sources(out, settings);
  append_calibration(out, settings);
  if (settings.navigation.enabled) {
    line(fmt::runtime("navigation: attitude, depth and position between fixes, every {} s"),
         settings.navigation.interval_s);
  } else {
    line(fmt::runtime("navigation: off"));
  }
  line(fmt::runtime("status: TCP {} port {}, at most {} clients"), settings.status.address, settings.status.port,
       settings.status.max_clients);
  line(fmt::runtime("control: {} with permissions {:04o}"), settings.control.socket.string(),
       settings.control.mode);
  return out;
}

}  // namespace navcal::daemon

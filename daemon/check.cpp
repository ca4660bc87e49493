// SPDX-License-Identifier: Apache-2.0
#include "daemon/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/motor_control.h"
#include "instruments/start_up.h"
#include "pipeline/calibration_options.h"
#include "pipeline/sources.h"

namespace navcal::daemon {
namespace {

using config::Role;
constexpr std::uint64_t kMB = 1'000'000;

std::string place(const config::PortSettings& port) {
  if (!port.path.empty()) return port.path;
  if (!port.udev_name.empty()) return fmt::format("udev name {}", port.udev_name);
  if (!port.address.empty()) return port.address;
  return fmt::format("USB adapter with serial number {}", port.usb_serial);
}

/// "compass", or "compass or gps" where the first that delivers serves; empty when there is none.
std::string names_of(const config::Settings& settings, const std::vector<std::uint16_t>& ports) {
  std::vector<std::string_view> names;
  for (const std::uint16_t port : ports) names.push_back(settings.ports[port].name);
  return fmt::format("{}", fmt::join(names, " or "));
}

/// "heading and field by compass, position by gps": which port may serve what; the first that delivers does.
void append_sources(std::string& out, const config::Settings& settings) {
  std::vector<std::string> groups, missing;
  std::string ports;
  for (const Role role : config::kRoles) {
    const std::string_view name = config::name_of(role);
    const std::string own = names_of(settings, pipeline::candidates(settings, role));
    if (own.empty()) {
      // Without an echo sounder, a Doppler log or a reference nothing else is missing.
      const bool is_extra = role == Role::altitude || role == Role::bottom_velocity ||
                            role == Role::water_velocity || role == Role::heading_reference;
      if (!is_extra) missing.emplace_back(name);
    } else if (own == ports) {
      groups.back().insert(groups.back().rfind(" by "), fmt::format(" and {}", name));
    } else {
      groups.push_back(fmt::format("{} by {}", name, own));
      ports = own;
    }
  }
  if (groups.empty()) return;
  out += fmt::format("sources: {}", fmt::join(groups, ", "));
  out += missing.empty() ? "\n" : fmt::format("; nothing gives {}\n", fmt::join(missing, ", "));
}

void append_calibration(std::string& out, const config::Settings& settings) {
  const auto ports = pipeline::calibrated_ports(settings);
  if (!settings.calibration.enabled || !ports.compass) {
    out += settings.calibration.enabled ? "calibration: nothing to calibrate\n" : "calibration: off\n";
    return;
  }
  std::vector<std::string> learnt;
  for (const Role role :
       {pipeline::compass_role(settings), Role::rates, Role::position, Role::shaft, Role::heading_reference}) {
    std::string name = names_of(settings, pipeline::learnable(settings, role));
    const bool is_new = std::find(learnt.begin(), learnt.end(), name) == learnt.end();
    if (!name.empty() && is_new) learnt.push_back(std::move(name));
  }
  out += fmt::format("calibration: of {}", fmt::join(learnt, ", "));
  if (settings.calibration.automatic) {
    out += fmt::format("; estimates become active when better by {:.0f} %\n", settings.calibration.margin * 100);
  } else {
    out += "; estimates become active by calibration.accept\n";
  }
}

void append_earth_field(std::string& out, const config::Settings& settings) {
  const pipeline::EarthField field(settings.environment);
  const bool is_known = field.declination_source != pipeline::EarthField::Source::none;
  out += "field of the Earth: ";
  if (is_known || !settings.environment.model) out += pipeline::words_for(field);
  if (settings.environment.model) {
    if (!is_known)
      out += "by the World Magnetic Model from the first fix on";
    else if (field.size_source == pipeline::EarthField::Source::none)
      out += "; size and dip by the model";
  }
  out += "\n";
}

void append_command(std::string& out, const config::Settings& settings) {
  const auto port = motor_port(settings);
  if (!port) {
    out += settings.command.enabled ? "orders: no motor card to give them to\n" : "orders: off\n";
    return;
  }
  const auto& command = settings.command;
  const auto slew = [](double rate, std::string_view unit) {
    return rate > 0 ? fmt::format("{} {}", rate, unit) : std::string("at once");
  };
  out += fmt::format(
      "orders: to {} up to {} rpm ({}) and {} deg ({}), at most {} a second; a lease of {} to {} s; then {} rpm, "
      "fins {} deg\n",
      settings.ports[*port].name, command.max_rpm, slew(command.slew_rpm_s, "rpm/s"), command.max_fin_deg,
      slew(command.slew_fin_deg_s, "deg/s"), command.max_orders_Hz, command.min_timeout_s, command.max_timeout_s,
      command.safe_rpm, fmt::join(command.safe_fins_deg, " "));
}

void append_power(std::string& out, const config::Settings& settings) {
  for (const auto& supply : settings.power) {
    constexpr std::string_view kAtStart[] = {"on at the start", "off at the start", "left as it is at the start"};
    out += fmt::format("power {}: of {} by line {} of {}, {}\n", supply.name, fmt::join(supply.devices, ", "),
                       supply.line, supply.gpio_chip, kAtStart[static_cast<std::size_t>(supply.at_start)]);
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
         settings.log.directory.string(), settings.log.sync_interval_s, settings.log.rotate_bytes / kMB,
         settings.log.rotate_age_s / 3600, settings.log.free_floor_bytes / kMB);
    if (!settings.log.leave_out.empty())
      line(fmt::runtime("log: without {}"), fmt::join(settings.log.leave_out, ", "));
  } else {
    line(fmt::runtime("log: off"));
  }
  append_power(out, settings);
  append_sources(out, settings);
  append_earth_field(out, settings);
  append_calibration(out, settings);
  if (settings.navigation.enabled) {
    line(fmt::runtime("navigation: attitude, depth and position between fixes, every {} s"),
         settings.navigation.interval_s);
  } else {
    line(fmt::runtime("navigation: off"));
  }
  const auto& battery = settings.battery;
  if (battery.enabled) {
    line(fmt::runtime("battery: {} Ah, {} V, low below {} %"), battery.capacity_Ah, battery.nominal_V,
         100 * battery.low);
  } else {
    line(fmt::runtime("battery: not counted"));
  }
  append_command(out, settings);
  line(fmt::runtime("status: TCP {} port {}, at most {} clients"), settings.status.address, settings.status.port,
       settings.status.max_clients);
  line(fmt::runtime("control: {} with permissions {:04o}"), settings.control.socket.string(),
       settings.control.mode);
  return out;
}

}  // namespace navcal::daemon

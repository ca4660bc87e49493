// SPDX-License-Identifier: Apache-2.0
#include "config/network_address.h"
#include "config/options.h"
#include "config/text_rules.h"
#include "protocols/device_types.h"

namespace navcal::config {
namespace {

using P = PortSettings;

const std::vector<std::string_view> kAngles{"deg", "mils", "counts16"};

std::vector<std::string_view> protocol_names() {
  std::vector<std::string_view> names;
  for (const auto& device : protocols::kDeviceTypes) names.push_back(device.name);
  return names;
}

/// The devices that have a table of options.
std::vector<protocols::Protocol> devices_with(bool protocols::OptionTables::*table) {
  std::vector<protocols::Protocol> devices;
  for (const auto& device : protocols::kDeviceTypes) {
    if (device.options.*table) devices.push_back(device.protocol);
  }
  return devices;
}

/// The devices that deliver one of these.
std::vector<protocols::Protocol> devices_of(protocols::RoleSet roles) {
  std::vector<protocols::Protocol> devices;
  for (const auto& device : protocols::kDeviceTypes) {
    if (device.delivers.has_any(roles)) devices.push_back(device.protocol);
  }
  return devices;
}

std::vector<Option<P>> make_port_options() {
  using protocols::Protocol;
  const auto port = table_of<P>("", std::identity());
  const auto of_described = table_of<P>("", std::identity(), {Protocol::described});
  const auto of_mavlink = table_of<P>("", std::identity(), {Protocol::mavlink});
  const auto of_nmea = table_of<P>("", std::identity(), {Protocol::nmea});
  const auto of_oncore = table_of<P>("", std::identity(), {Protocol::oncore});
  const auto units = table_of<P>("units", &P::compass, devices_with(&protocols::OptionTables::units));
  const auto channels = table_of<P>("channels", &P::imu_card, devices_with(&protocols::OptionTables::channels));
  const auto turned = table_of<P>("mounting", &P::mounting,
                                  devices_of({Role::heading, Role::field, Role::rates, Role::bottom_velocity}));
  const auto placed =
      table_of<P>("mounting", &P::mounting,
                  devices_of({Role::acceleration, Role::depth, Role::position, Role::bottom_velocity}));
  const auto fix = table_of<P>("fix", &P::gps, devices_with(&protocols::OptionTables::fix));
  auto scale = channels.channels("scale", &ImuCardSettings::scale, kMillivoltsPer, -100000, 100000);
  scale.zero_allowed = false;
  return {
      port.choice("protocol", &P::protocol, protocol_names()),
      port.text("path", &P::path, is_local_path, "a path on this machine without control characters"),
      port.text("udev_name", &P::udev_name, is_printable, "a name without control characters"),
      port.text("usb_serial", &P::usb_serial, is_printable, "a serial number without control characters"),
      port.text(
          "address", &P::address, [](std::string_view text) { return parse_network_address(text).has_value(); },
          "tcp:, tcp-listen: or udp: with an IP address and a port, or unix-listen: with an absolute path"),
      port.text("serial_number", &P::serial_number, is_short_or_nothing,
                "at most 64 bytes without control characters"),
      of_described.text("device", &P::device, is_local_path, "a path on this machine without control characters"),
      of_described.text(
          "description", &P::description, [](std::string_view text) { return !text.empty(); },
          "the description of a device"),
      of_described.list(
          "adjust", &P::adjust, [](std::string_view text) { return text.find(':') != std::string_view::npos; },
          "a field with zero, scale or sensitivity: \"rate.x: zero = 2051, sensitivity = 10.02\""),
      port.integer("baud", &P::baud, kBits, 50, 4000000),
      port.boolean("start_up", &P::start_up),
      of_oncore.boolean("aid", &P::aid),
      of_nmea.boolean("require_checksum", &P::require_checksum),
      of_mavlink.integer("inertial_unit", &P::inertial_unit, kNoUnit, 1, 3),
      of_mavlink.integer("pressure_sensor", &P::pressure_sensor, kNoUnit, 1, 4),
      of_mavlink.text("signing_key_file", &P::signing_key_file, is_absolute_path_or_nothing,
                      "an absolute path, or nothing"),
      port.boolean("low_latency", &P::low_latency),
      port.number("latency_ms", &P::latency_s, kMilliseconds, 0, 10000),
      port.number("latency_std_ms", &P::latency_std_s, kMilliseconds, 0, 10000),
      port.number("rate_Hz", &P::rate_Hz, kHertz, 0, 1000),

      units.choice("heading", &CompassSettings::heading_unit, kAngles),
      units.choice("tilt", &CompassSettings::tilt_unit, kAngles),
      units.choice("temperature", &CompassSettings::temperature_unit, {"C", "F"}),

      channels.channels("zero_mV", &ImuCardSettings::zero_mV, kMillivolts, -10000, 10000),
      scale,

      fix.text("rollover_pivot", &GpsSettings::rollover_pivot, is_gps_date,
               "a date, YYYY-MM-DD, from 1980-01-06 on"),
      fix.number("course_gate_m_s", &GpsSettings::course_gate_m_s, kMetresPerSecond, 0, 100),

      turned.channels("rotation_deg", &MountingSettings::rotation_deg, kPlainDegrees, -360, 360),
      placed.channels("position_m", &MountingSettings::position_m, kMetres, -100, 100),
  };
}

}  // namespace

const std::vector<Option<P>>& port_options() {
  static const std::vector<Option<P>> options = make_port_options();
  return options;
}

}  // namespace navcal::config

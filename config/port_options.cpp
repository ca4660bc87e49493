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

std::vector<protocols::Protocol> devices_that(bool (*delivers)(const protocols::Delivery&)) {
  std::vector<protocols::Protocol> devices;
  for (const auto& device : protocols::kDeviceTypes) {
    if (delivers(device.delivers)) devices.push_back(device.protocol);
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
  const auto turned =
      table_of<P>("mounting", &P::mounting, devices_that([](const protocols::Delivery& delivers) {
                    return delivers.heading || delivers.field || delivers.rates || delivers.bottom_velocity;
                  }));
  const auto placed = table_of<P>("mounting", &P::mounting, devices_that([](const protocols::Delivery& delivers) {
                                    return delivers.acceleration || delivers.depth || delivers.position ||
                                           delivers.bottom_velocity;
                                  }));
  const auto fix = table_of<P>("fix", &P::gps, devices_with(&protocols::OptionTables::fix));
  auto scale =
      channels.channels("scale", &ImuCardSettings::scale, kMillivoltsPer, -100000, 100000,
                        "Sensitivity of the same channels; negative for a sensor that is mounted in reverse.");
  scale.zero_allowed = false;
  return {
      port.choice("protocol", &P::protocol, protocol_names(), "Protocol of the device."),
      port.text("path", &P::path, is_local_path, "a path on this machine without control characters",
                "Path of the device: a tty, a pseudo-terminal or a link to one."),
      port.text("udev_name", &P::udev_name, is_printable, "a name without control characters",
                "Instead of path: a link created by udev, such as /dev/navcal/compass."),
      port.text("usb_serial", &P::usb_serial, is_printable, "a serial number without control characters",
                "Instead of path: the serial number of the USB adapter (navcal ports shows it)."),
      port.text(
          "address", &P::address, [](std::string_view text) { return parse_network_address(text).has_value(); },
          "tcp:, tcp-listen: or udp: with an IP address and a port, or unix-listen: with an absolute path",
          "Instead of path: tcp:HOST:PORT (navcald connects), tcp-listen:ADDRESS:PORT (the device connects), "
          "udp:ADDRESS:PORT (datagrams that arrive there) or unix-listen:PATH (programs on this computer connect, "
          "several at once)."),
      port.text("serial_number", &P::serial_number, is_short_or_nothing,
                "at most 64 bytes without control characters",
                "Serial number of the device itself, as on its plate, so that it is known again on another port "
                "or vehicle; empty: not given."),
      of_described.text(
          "device", &P::device, is_local_path, "a path on this machine without control characters",
          "File that describes the device (docs/devices.md); a relative path begins where this file lies."),
      of_described.text(
          "description", &P::description, [](std::string_view text) { return !text.empty(); },
          "the description of a device",
          "The text of that file, so that it need not be there; navcald writes it into its logs."),
      of_described.list(
          "adjust", &P::adjust, [](std::string_view text) { return text.find(':') != std::string_view::npos; },
          "a field with zero, scale or sensitivity: \"rate.x: zero = 2051, sensitivity = 10.02\"",
          "What belongs to the single device, beyond its description."),
      port.integer("baud", &P::baud, kBits, 50, 4000000,
                   "Line speed, 8N1; with address that of the serial line behind the converter."),
      port.boolean("start_up", &P::start_up,
                   "Set the device to this configuration at start-up, by its own commands."),
      of_oncore.boolean(
          "aid", &P::aid,
          "Give the receiver position and time when it has lost both, by its own commands (docs/surfacing.md)."),
      of_nmea.boolean("require_checksum", &P::require_checksum,
                      "Take only sentences with a checksum. Without this, damaged ones that have none pass as "
                      "good: for old devices that send none."),
      of_mavlink.integer("inertial_unit", &P::inertial_unit, kNoUnit, 1, 3,
                         "Number of the autopilot's inertial unit with its compass that is taken."),
      of_mavlink.integer("pressure_sensor", &P::pressure_sensor, kNoUnit, 1, 4,
                         "Number of the autopilot's pressure sensor that is taken; of a BlueROV2 1 is inside the "
                         "hull. 4: the primary one, by HIGHRES_IMU."),
      of_mavlink.text("signing_key_file", &P::signing_key_file, is_absolute_path_or_nothing,
                      "an absolute path, or nothing",
                      "File with the key of MAVLink's signatures: 64 hexadecimal digits, or the passphrase of the "
                      "ground station, of 16 characters or more. Only its owner may have access to it. With it, "
                      "messages without a good signature are not read."),
      port.boolean("low_latency", &P::low_latency, "Ask the driver to deliver bytes without delay."),
      port.number("latency_ms", &P::latency_s, kMilliseconds, 0, 10000,
                  "Time from the measurement to the first byte on the wire."),
      port.number("latency_std_ms", &P::latency_std_s, kMilliseconds, 0, 10000,
                  "Uncertainty of latency_ms, one standard deviation."),
      port.number("rate_Hz", &P::rate_Hz, kHertz, 0, 1000, "Nominal frame rate; 0 if the device has none."),

      units.choice("heading", &CompassSettings::heading_unit, kAngles,
                   "Unit of the heading on the wire; mils: 6400 to the turn, counts16: 65536."),
      units.choice("tilt", &CompassSettings::tilt_unit, kAngles, "Unit of pitch and roll on the wire."),
      units.choice("temperature", &CompassSettings::temperature_unit, {"C", "F"},
                   "Unit of the temperature on the wire; some TCM2 are delivered in F."),

      channels.channels("zero_mV", &ImuCardSettings::zero_mV, kMillivolts, -10000, 10000,
                        "Reading at zero: gyro A x, A z, B y, B z, accelerometer x, y, z, depth."),
      scale,

      fix.text("rollover_pivot", &GpsSettings::rollover_pivot, is_gps_date,
               "a date, YYYY-MM-DD, from 1980-01-06 on",
               "Dates before this one are advanced by whole epochs of 1024 weeks (GPS week rollover); set it once "
               "and keep it."),
      fix.number("course_gate_m_s", &GpsSettings::course_gate_m_s, kMetresPerSecond, 0, 100,
                 "Below this speed the course over ground is noise and is left out."),

      turned.channels(
          "rotation_deg", &MountingSettings::rotation_deg, kPlainDegrees, -360, 360,
          "Roll, pitch and yaw of a compass, inertial card or Doppler log in the vehicle: the turns about z, then "
          "y, then x that bring the vehicle's axes (x forward, y starboard, z down) on to the device's."),
      placed.channels("position_m", &MountingSettings::position_m, kMetres, -100, 100,
                      "Place of an inertial card, antenna, Doppler log or pressure gauge from the vehicle's "
                      "origin: forward, to starboard, down."),
  };
}

}  // namespace

const std::vector<Option<P>>& port_options() {
  static const std::vector<Option<P>> options = make_port_options();
  return options;
}

}  // namespace navcal::config

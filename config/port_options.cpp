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
  const auto with_units = devices_with(&protocols::OptionTables::units);
  const auto with_channels = devices_with(&protocols::OptionTables::channels);
  const auto with_fix = devices_with(&protocols::OptionTables::fix);
  const auto with_rotation = devices_that([](const protocols::Delivery& delivers) {
    return delivers.heading || delivers.field || delivers.rates || delivers.bottom_velocity;
  });
  const auto with_position = devices_that([](const protocols::Delivery& delivers) {
    return delivers.acceleration || delivers.depth || delivers.position || delivers.bottom_velocity;
  });
  const NumberOf<P> number{};
  return {
      choice<P>(
          {.key = "protocol", .description = "Protocol of the device.", .choices = protocol_names()},
          [](auto& p) -> auto& { return p.protocol; }),
      text<P>(
          {.key = "path",
           .description = "Path of the device: a tty, a pseudo-terminal or a link to one.",
           .text_rule = "a path on this machine without control characters",
           .text_holds = is_local_path},
          [](auto& p) -> auto& { return p.path; }),
      text<P>(
          {.key = "udev_name",
           .description = "Instead of path: a link created by udev, such as /dev/navcal/compass.",
           .text_rule = "a name without control characters",
           .text_holds = is_printable},
          [](auto& p) -> auto& { return p.udev_name; }),
      text<P>(
          {.key = "usb_serial",
           .description = "Instead of path: the serial number of the USB adapter (navcal ports shows it).",
           .text_rule = "a serial number without control characters",
           .text_holds = is_printable},
          [](auto& p) -> auto& { return p.usb_serial; }),
      text<P>(
          {.key = "address",
           .description =
               "Instead of path: tcp:HOST:PORT (navcald connects), tcp-listen:ADDRESS:PORT (the device "
               "connects), udp:ADDRESS:PORT (datagrams that arrive there) or unix-listen:PATH (programs on this "
               "computer connect, several at once).",
           .text_rule =
               "tcp:, tcp-listen: or udp: with an IP address and a port, or unix-listen: with an absolute path",
           .text_holds = [](std::string_view text) { return parse_network_address(text).has_value(); }},
          [](auto& p) -> auto& { return p.address; }),
      text<P>(
          {.key = "serial_number",
           .description =
               "Serial number of the device itself, as on its plate, so that it is known again on another "
               "port or vehicle; empty: not given.",
           .text_rule = "at most 64 bytes without control characters",
           .text_holds = is_short_or_nothing},
          [](auto& p) -> auto& { return p.serial_number; }),
      text<P>(
          {.key = "device",
           .description =
               "File that describes the device (docs/devices.md); a relative path begins where this file "
               "lies.",
           .text_rule = "a path on this machine without control characters",
           .text_holds = is_local_path,
           .only_for = {protocols::Protocol::described}},
          [](auto& p) -> auto& { return p.device; }),
      text<P>(
          {.key = "description",
           .description = "The text of that file, so that it need not be there; navcald writes it into its logs.",
           .text_rule = "the description of a device",
           .text_holds = [](std::string_view text) { return !text.empty(); },
           .only_for = {protocols::Protocol::described}},
          [](auto& p) -> auto& { return p.description; }),
      list<P>(
          {.key = "adjust",
           .description = "What belongs to the single device, beyond its description.",
           .text_rule = "a field with zero, scale or sensitivity: \"rate.x: zero = 2051, sensitivity = 10.02\"",
           .text_holds = [](std::string_view text) { return text.find(':') != std::string_view::npos; },
           .only_for = {protocols::Protocol::described}},
          [](auto& p) -> auto& { return p.adjust; }),
      integer<P>(
          {.key = "baud",
           .description = "Line speed, 8N1; with address that of the serial line behind the converter.",
           .unit = kBits,
           .low = 50,
           .high = 4000000},
          [](auto& p) -> auto& { return p.baud; }),
      boolean<P>(
          {.key = "start_up",
           .description = "Set the device to this configuration at start-up, by its own commands."},
          [](auto& p) -> auto& { return p.start_up; }),
      boolean<P>(
          {.key = "aid",
           .description = "Give the receiver position and time when it has lost both, by its own commands "
                          "(docs/surfacing.md).",
           .only_for = {protocols::Protocol::oncore}},
          [](auto& p) -> auto& { return p.aid; }),
      boolean<P>(
          {.key = "require_checksum",
           .description = "Take only sentences with a checksum. Without this, damaged ones that have none pass as "
                          "good: for old devices that send none.",
           .only_for = {protocols::Protocol::nmea}},
          [](auto& p) -> auto& { return p.require_checksum; }),
      integer<P>(
          {.key = "inertial_unit",
           .description = "Number of the autopilot's inertial unit with its compass that is taken.",
           .low = 1,
           .high = 3,
           .only_for = {protocols::Protocol::mavlink}},
          [](auto& p) -> auto& { return p.inertial_unit; }),
      integer<P>(
          {.key = "pressure_sensor",
           .description = "Number of the autopilot's pressure sensor that is taken; of a BlueROV2 1 is inside the "
                          "hull. 4: the primary one, by HIGHRES_IMU.",
           .low = 1,
           .high = 4,
           .only_for = {protocols::Protocol::mavlink}},
          [](auto& p) -> auto& { return p.pressure_sensor; }),
      boolean<P>(
          {.key = "low_latency", .description = "Ask the driver to deliver bytes without delay."},
          [](auto& p) -> auto& { return p.low_latency; }),
      number(
          "latency_ms", "Time from the measurement to the first byte on the wire.", kMilliseconds, 0, 10000,
          [](auto& p) -> auto& { return p.latency_s; }),
      number(
          "latency_std_ms", "Uncertainty of latency_ms, one standard deviation.", kMilliseconds, 0, 10000,
          [](auto& p) -> auto& { return p.latency_std_s; }),
      number(
          "rate_Hz", "Nominal frame rate; 0 if the device has none.", kHertz, 0, 1000,
          [](auto& p) -> auto& { return p.rate_Hz; }),

      choice<P>(
          {.table = "units",
           .key = "heading",
           .description = "Unit of the heading on the wire; mils: 6400 to the turn, counts16: 65536.",
           .choices = kAngles,
           .only_for = with_units},
          [](auto& p) -> auto& { return p.compass.heading_unit; }),
      choice<P>(
          {.table = "units",
           .key = "tilt",
           .description = "Unit of pitch and roll on the wire.",
           .choices = kAngles,
           .only_for = with_units},
          [](auto& p) -> auto& { return p.compass.tilt_unit; }),
      choice<P>(
          {.table = "units",
           .key = "temperature",
           .description = "Unit of the temperature on the wire; some TCM2 are delivered in F.",
           .choices = {"C", "F"},
           .only_for = with_units},
          [](auto& p) -> auto& { return p.compass.temperature_unit; }),

      channels<P>(
          {.table = "channels",
           .key = "zero_mV",
           .description = "Reading at zero: gyro A x, A z, B y, B z, accelerometer x, y, z, depth.",
           .unit = kMillivolts,
           .low = -10000,
           .high = 10000,
           .only_for = with_channels},
          [](auto& p) -> auto& { return p.imu_card.zero_mV; }),
      channels<P>(
          {.table = "channels",
           .key = "scale",
           .description = "Sensitivity of the same channels; negative for a sensor that is mounted in reverse.",
           .unit = kMillivoltsPer,
           .low = -100000,
           .high = 100000,
           .zero_allowed = false,
           .only_for = with_channels},
          [](auto& p) -> auto& { return p.imu_card.scale; }),

      text<P>(
          {.table = "fix",
           .key = "rollover_pivot",
           .description = "Dates before this one are advanced by whole epochs of 1024 weeks (GPS week rollover); "
                          "set it once and keep it.",
           .text_rule = "a date, YYYY-MM-DD, from 1980-01-06 on",
           .text_holds = is_gps_date,
           .only_for = with_fix},
          [](auto& p) -> auto& { return p.gps.rollover_pivot; }),
      real<P>(
          {.table = "fix",
           .key = "course_gate_m_s",
           .description = "Below this speed the course over ground is noise and is left out.",
           .unit = kMetresPerSecond,
           .low = 0,
           .high = 100,
           .only_for = with_fix},
          [](auto& p) -> auto& { return p.gps.course_gate_m_s; }),

      channels<P>(
          {.table = "mounting",
           .key = "rotation_deg",
           .description =
               "Roll, pitch and yaw of a compass, inertial card or Doppler log in the vehicle: the turns about z, "
               "then y, then x "
               "that bring the vehicle's axes (x forward, y starboard, z down) on to the device's.",
           .unit = kPlainDegrees,
           .low = -360,
           .high = 360,
           .count = 3,
           .only_for = with_rotation},
          [](auto& p) -> auto& { return p.mounting.rotation_deg; }),
      channels<P>(
          {.table = "mounting",
           .key = "position_m",
           .description =
               "Place of an inertial card, antenna, Doppler log or pressure gauge from the vehicle's origin: "
               "forward, to starboard, down.",
           .unit = kMetres,
           .low = -100,
           .high = 100,
           .count = 3,
           .only_for = with_position},
          [](auto& p) -> auto& { return p.mounting.position_m; }),
  };
}

}  // namespace

const std::vector<Option<P>>& port_options() {
  static const std::vector<Option<P>> options = make_port_options();
  return options;
}

}  // namespace navcal::config

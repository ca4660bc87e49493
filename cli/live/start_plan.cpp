// SPDX-License-Identifier: Apache-2.0
#include "cli/live/start_plan.h"

#include <fmt/format.h>

#include "base/failure.h"
#include "config/load.h"
#include "config/value.h"
#include "ports/port_list.h"
#include "protocols/device_types.h"

namespace navcal::cli {
namespace {

std::string toml_line(std::string_view key, const config::Value& value) {
  return fmt::format("{} = {}\n", key, config::to_toml_text(value));
}

/// The place of a serial port: the one that is named, or the only one of this machine.
std::string serial_place(const StartRequest& request, int usual_baud) {
  const std::string baud = toml_line("baud", std::int64_t{request.baud > 0 ? request.baud : usual_baud});
  if (!request.device.empty()) return toml_line("path", std::filesystem::absolute(request.device).string()) + baud;
  const auto found = ports::list_ports();
  if (found.size() == 1 && !found[0].usb_serial.empty())
    return toml_line("usb_serial", found[0].usb_serial) + baud;
  if (found.size() == 1) return toml_line("path", found[0].path) + baud;
  throw base::Failure(base::Exit::failed, fmt::format("start: this machine has {} serial ports; `navcal ports` "
                                                      "lists them, and --device names the one that is meant",
                                                      found.size()));
}

std::string network_place(const std::string& address) {
  return toml_line("address", address) + toml_line("baud", std::int64_t{4'000'000});  // no serial line in between
}

std::string port_of_bluerov2(const StartRequest& request, StartPlan& plan) {
  plan.expected = {{"rates", "The autopilot does not send its inertial unit."},
                   {"field", "The autopilot has no compass, or does not send it."},
                   {"depth", "Try pressure_sensor = 1, 3 or 4 in the configuration."}};
  std::string place;
  if (!request.device.empty() || request.baud > 0) {
    place = serial_place(request, 115200);
    if (request.baud > 0 && request.baud <= 57600) place += "rate_Hz = 20\n";  // it has no room for more
    plan.silent = "Does this port of the autopilot speak MAVLink, and at this baud (57600 and 115200 are usual)?";
  } else {
    place = network_place(request.address.empty() ? "udp:0.0.0.0:14551" : request.address);
    plan.silent =
        "In BlueOS, MAVLink Endpoints, add a UDP client with this computer's address and the port of the "
        "configuration, by default 14551. On the vehicle's own computer --address tcp:127.0.0.1:5777 needs none. "
        "Does a firewall of this computer let the datagrams in?";
  }
  return toml_line("protocol", "mavlink") + place + "pressure_sensor = 2  # 1 is inside the hull\n";
}

std::string port_of_ros2(const StartRequest& /*request*/, StartPlan& plan) {
  plan.samples = plan.is_service ? "/run/navcal/samples" : plan.configuration.parent_path() / "samples";
  plan.silent =
      "`ros2 topic hz TOPIC` says whether somebody publishes. Is ROS_DOMAIN_ID the same, and do both sides use "
      "the same network (CYCLONEDDS_URI, docs/ros2.md)?";
  return toml_line("protocol", "samples") + toml_line("address", "unix-listen:" + plan.samples);
}

std::string port_of_gpsd(const StartRequest& request, StartPlan& plan) {
  plan.expected = {{"position", "The receiver has no fix yet: its antenna must see the sky."}};
  plan.silent = "Has the receiver power, and is the baud right (--baud 4800, 9600, 38400)?";
  return toml_line("protocol", "nmea") + serial_place(request, 9600);
}

std::string port_of_nmea(const StartRequest& request, StartPlan& plan) {
  plan.silent =
      "Is the device switched on and set to NMEA 0183, and is the baud right (--baud 4800, 9600, 38400)?";
  return toml_line("protocol", "nmea") +
         (request.address.empty() ? serial_place(request, config::default_baud(protocols::Protocol::nmea))
                                  : network_place(request.address));
}

struct StartKind {
  std::string_view name, port;
  bool has_address, has_device;
  std::string (*make)(const StartRequest&, StartPlan&);
};
constexpr StartKind kStartKinds[] = {{"bluerov2", "rov", true, true, port_of_bluerov2},
                                     {"ros2", "ros", false, false, port_of_ros2},
                                     {"gpsd", "gps", false, true, port_of_gpsd},
                                     {"nmea", "nmea", true, true, port_of_nmea}};

}  // namespace

StartPlan start_plan(const StartRequest& request) {
  const StartKind* kind = kStartKinds;
  while (kind->name != request.kind) ++kind;
  const bool has_address = !request.address.empty(), has_device = !request.device.empty() || request.baud > 0;
  if ((has_address && (has_device || !kind->has_address)) || (has_device && !kind->has_device) ||
      (!request.topics.empty() && request.kind != "ros2"))
    throw base::Failure(base::Exit::usage,
                        "start: --for " + request.kind + " does not take these options, or not together");

  StartPlan plan;
  plan.port = kind->port;
  const std::filesystem::path usual = "navcal-" + request.kind + "/navcald.toml";
  plan.configuration =
      std::filesystem::absolute(request.output.empty() ? usual : request.output).lexically_normal();
  const auto folder = plan.configuration.parent_path();
  plan.is_service = folder == "/etc/navcal";
  plan.toml =
      fmt::format("# Written by `navcal start --for {}`. docs/configuration.md has all options.\n", request.kind);
  if (!plan.is_service) {
    plan.toml += "\n[log]\n" + toml_line("directory", (folder / "log").string());
    plan.toml += "\n[control]\n" + toml_line("socket", (folder / "control").string());
  }
  plan.toml += "\n[status]\n" + toml_line("port", std::int64_t{request.status_port});
  plan.toml += fmt::format("\n[port.{}]\n{}", plan.port, kind->make(request, plan));
  return plan;
}

}  // namespace navcal::cli

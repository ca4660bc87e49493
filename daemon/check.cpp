#include "daemon/check.h"

#include <fmt/format.h>

#include <iterator>

#include "instruments/start_up.h"
#include "pipeline/calibration_options.h"

namespace navcal::daemon {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;

std::string place(const config::PortSettings& port) {
  if (!port.path.empty()) return port.path;
  if (!port.udev_name.empty()) return fmt::format("udev name {}", port.udev_name);
  return fmt::format("USB adapter with serial number {}", port.usb_serial);
}

void append_calibration(std::string& out, const config::Settings& settings) {
  const auto ports = pipeline::calibrated_ports(settings);
  if (!settings.calibration.enabled || !ports.compass) {
    out += settings.calibration.enabled ? "calibration: nothing to calibrate\n" : "calibration: off\n";
    return;
  }
  out += fmt::format("calibration: of {}", settings.ports[*ports.compass].name);
  for (const auto& helper : {ports.imu, ports.gps, ports.motor}) {
    if (helper && helper != ports.compass) out += fmt::format(", {}", settings.ports[*helper].name);
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "daemon/gpsd_reports.h"
#include "daemon/status_server.h"
#include "instruments/samples.h"
#include "pipeline/battery.h"
#include "pipeline/navigation.h"

namespace navcal::daemon {

/// Index of the estimate's virtual device, which follows those of the ports.
[[nodiscard]] inline std::uint16_t navigation_device(const config::Settings& settings) {
  return static_cast<std::uint16_t>(settings.ports.size());
}

/// Makes the reports of the status socket from samples: once for all watching clients, and not at all without
/// one.
class Publisher {
 public:
  Publisher(const config::Settings& settings, StatusServer& server);

  void sample(const instruments::Sample& sample);
  /// Publishes NAV to all clients. While no fix is current it also publishes TPV, because the receivers' own
  /// TPV then has no position.
  void navigation(const pipeline::NavigationSample& sample);
  /// Publishes BATTERY; its device is the instrument whose sample called for it.
  void battery(const pipeline::BatterySample& sample);
  void set_earth_field(const pipeline::EarthField& field) { earth_field_ = field; }
  /// False while UTC is unknown, so that reports omit their times.
  void set_utc_known(bool known) { utc_known_ = known; }
  /// The answer to ?POLL;: the last position and satellites of every receiver, and the reckoned position while no
  /// fix is current.
  void append_poll(std::string& out, std::optional<std::int64_t> utc_ns) const;

 private:
  /// Samples that POLL repeats.
  struct Last {
    std::optional<instruments::GpsSample> gps;
    instruments::Stamp gps_stamp;
    std::optional<instruments::SkySample> sky;
    instruments::Stamp sky_stamp;
  };
  void append(const instruments::Sample& sample, ReportSource source);
  [[nodiscard]] ReportSource source(std::uint16_t port) const {
    const config::PortSettings& settings = settings_.ports[port];
    return {settings.name, utc_known_, {}, settings.protocol == protocols::Protocol::mavlink};
  }

  const config::Settings& settings_;
  StatusServer& server_;
  pipeline::EarthField earth_field_;
  std::vector<Last> last_;
  std::optional<pipeline::NavigationSample> last_navigation_;
  std::string report_;
  bool utc_known_ = false;
};

}  // namespace navcal::daemon

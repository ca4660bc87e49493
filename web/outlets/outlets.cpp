// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/outlets.h"

#include <nlohmann/json.hpp>

#include "web/outlets/chrony.h"
#include "web/outlets/mavlink.h"
#include "web/outlets/metrics.h"
#include "web/outlets/mqtt.h"
#include "web/outlets/signalk.h"

namespace navcal::web {

std::string blueos_service(std::string_view version) {
  nlohmann::ordered_json service{{"name", "navcal"},
                                 {"description", "Navigation and calibration of the vehicle's instruments"},
                                 {"icon", "mdi-compass-outline"},
                                 {"company", "navcal"}};
  service["version"] = version;
  service["webpage"] = "/";
  service["api"] = "/signalk";
  service["works_in_relative_paths"] = true;
  return service.dump();
}

struct Outlets::Parts {
  Parts(const boost::asio::any_io_executor& executor, const OutletOptions& options, Hub& hub, Site& site)
      : metrics(hub),
        signalk(hub, site, options.vessel.empty() ? default_vessel() : options.vessel, options.version) {
    if (!options.mqtt.broker.empty()) {
      mqtt = std::make_unique<Mqtt>(executor, options.mqtt, hub);
      metrics.watch(mqtt->counters());
    }
    if (!options.chrony_socket.empty()) {
      chrony = std::make_unique<Chrony>(executor, options.chrony_socket, hub);
      metrics.watch(chrony->counters());
    }
    if (!options.mavlink.address.empty()) {
      mavlink = std::make_unique<Mavlink>(executor, options.mavlink, hub);
      metrics.watch(mavlink->counters());
    }
  }

  Metrics metrics;
  SignalK signalk;
  std::unique_ptr<Mqtt> mqtt;
  std::unique_ptr<Chrony> chrony;
  std::unique_ptr<Mavlink> mavlink;
};

Outlets::Outlets(const boost::asio::any_io_executor& executor, const OutletOptions& options, Hub& hub, Site& site)
    : parts_(std::make_unique<Parts>(executor, options, hub, site)) {
  site.add("GET", "/metrics", parts_->metrics.handler());
  site.add("GET", "/register_service", json_handler(blueos_service(options.version)));
}

Outlets::~Outlets() { stop(); }

void Outlets::watch(const ServerCounters& server, const LiveSource::Counters& source) {
  parts_->metrics.watch(server, source);
}

void Outlets::stop() {
  if (parts_->mqtt) parts_->mqtt->stop();
}

}  // namespace navcal::web

// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/outlets.h"

#include "web/outlets/blueos.h"
#include "web/outlets/chrony.h"
#include "web/outlets/metrics.h"
#include "web/outlets/mqtt.h"
#include "web/outlets/signalk.h"

namespace navcal::web {

struct Outlets::Parts {
  Parts(const boost::asio::any_io_executor& executor, const OutletOptions& options, Hub& hub, Site& site)
      : metrics(hub),
        signalk(hub, site, options.vessel.empty() ? default_vessel() : options.vessel, options.version) {
    if (!options.mqtt.broker.empty()) {
      mqtt = std::make_shared<Mqtt>(executor, options.mqtt, hub);
      mqtt->start();
      metrics.watch(mqtt->counters());
    }
    if (!options.chrony_socket.empty()) {
      chrony = std::make_unique<Chrony>(executor, options.chrony_socket, hub);
      metrics.watch(chrony->counters());
    }
  }

  Metrics metrics;
  SignalK signalk;
  std::shared_ptr<Mqtt> mqtt;
  std::unique_ptr<Chrony> chrony;
};

Outlets::Outlets(const boost::asio::any_io_executor& executor, const OutletOptions& options, Hub& hub, Site& site)
    : parts_(std::make_unique<Parts>(executor, options, hub, site)) {
  site.add("GET", "/metrics", parts_->metrics.handler());
  site.add("GET", "/register_service", blueos_handler(options.version));
}

Outlets::~Outlets() { stop(); }

void Outlets::watch(const ServerCounters& server, const LiveSource::Counters& source) {
  parts_->metrics.watch(server, source);
}

void Outlets::stop() {
  if (parts_->mqtt) parts_->mqtt->stop();
}

}  // namespace navcal::web

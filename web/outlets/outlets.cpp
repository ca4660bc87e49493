// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/outlets.h"

#include "web/outlets/blueos.h"
#include "web/outlets/metrics.h"
#include "web/outlets/signalk.h"

namespace navcal::web {

struct Outlets::Parts {
  Parts(const OutletOptions& options, Hub& hub, Site& site)
      : metrics(hub),
        signalk(hub, site, options.vessel.empty() ? default_vessel() : options.vessel, options.version) {}

  Metrics metrics;
  SignalK signalk;
};

Outlets::Outlets(const boost::asio::any_io_executor&, const OutletOptions& options, Hub& hub, Site& site)
    : parts_(std::make_unique<Parts>(options, hub, site)) {
  site.add("GET", "/metrics", parts_->metrics.handler());
  site.add("GET", "/register_service", blueos_handler(options.version));
}

Outlets::~Outlets() = default;

void Outlets::watch(const ServerCounters& server, const LiveSource::Counters& source) {
  parts_->metrics.watch(server, source);
}

void Outlets::stop() {}

}  // namespace navcal::web

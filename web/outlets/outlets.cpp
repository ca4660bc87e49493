// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/outlets.h"

#include <nlohmann/json.hpp>

#include "record/json/put_members.h"
#include "web/outlets/chrony.h"
#include "web/outlets/daemon_metrics.h"
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
      : metrics(hub), signalk(add_signalk(hub, site, options.vessel.empty() ? default_vessel() : options.vessel,
                                          options.version)) {
    if (!options.mqtt.broker.empty()) mqtt = make_mqtt(executor, options.mqtt, hub, mqtt_counters);
    if (!options.chrony_socket.empty()) chrony = std::make_unique<Chrony>(executor, options.chrony_socket, hub);
    if (!options.mavlink.address.empty()) mavlink = make_mavlink(executor, options.mavlink, hub, mavlink_counters);
    metrics.watch([this](Exposition& out) { append(out); });
  }
  ~Parts() { signalk->detach(); }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void append(Exposition& out) const {
    nlohmann::json counters;
    if (mqtt) {
      NAVCAL_PUT_MEMBERS(counters, mqtt_counters, connected, published, dropped);
      append_members(out, counters, members_of("mqtt"));
    }
    if (chrony) {
      NAVCAL_PUT_MEMBERS(counters, chrony->counters(), samples, not_sent);
      append_members(out, counters, members_of("chrony"));
    }
    if (mavlink) {
      NAVCAL_PUT_MEMBERS(counters, mavlink_counters, open, has_position, sent, dropped, received, refused);
      append_members(out, counters, members_of("mavlink"));
    }
  }

  Metrics metrics;
  std::shared_ptr<SignalKFeed> signalk;
  std::unique_ptr<Chrony> chrony;
  MqttCounters mqtt_counters;
  MavlinkCounters mavlink_counters;
  std::unique_ptr<Subscriber> mqtt, mavlink;
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

void Outlets::stop() { parts_->mqtt.reset(); }

}  // namespace navcal::web

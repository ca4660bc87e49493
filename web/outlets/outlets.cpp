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
    if (mqtt) {
      out.single("navcal_web_mqtt_connected", "1 while there is a connection to the MQTT broker.",
                 mqtt_counters.connected);
      out.single("navcal_web_mqtt_published_messages_total", "Messages that the MQTT broker got.",
                 mqtt_counters.published);
      out.single("navcal_web_mqtt_dropped_messages_total",
                 "Messages dropped, because there was no MQTT broker or it was too slow.", mqtt_counters.dropped);
    }
    if (chrony) {
      out.single("navcal_web_chrony_samples_total", "Samples that chronyd got.", chrony->counters().samples);
      out.single("navcal_web_chrony_failed_samples_total", "Samples that nobody took.",
                 chrony->counters().not_sent);
    }
    if (mavlink) {
      out.single("navcal_web_mavlink_open", "1 while the line of MAVLink is open.", mavlink_counters.open);
      out.single("navcal_web_mavlink_position", "1 while a position goes out by MAVLink.",
                 mavlink_counters.has_position);
      out.single("navcal_web_mavlink_sent_messages_total", "Messages that the line of MAVLink took.",
                 mavlink_counters.sent);
      out.single("navcal_web_mavlink_dropped_messages_total",
                 "Messages dropped, because the line of MAVLink was away or too slow.", mavlink_counters.dropped);
      out.single("navcal_web_mavlink_received_messages_total", "Messages that came by MAVLink.",
                 mavlink_counters.received);
      out.single("navcal_web_mavlink_refused_messages_total", "Of those, messages without a good signature.",
                 mavlink_counters.refused);
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

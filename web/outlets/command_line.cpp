// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/command_line.h"

#include "web/outlets/mqtt_topics.h"
#include "web/outlets/signalk.h"

namespace navcal::web {

void add_outlet_options(CLI::App& app, OutletOptions& options) {
  const auto broker_problem = [](const std::string& text) {
    return mqtt_broker(text) ? std::string() : std::string("wants HOST or HOST:PORT");
  };
  app.add_option("--vessel", options.vessel,
                 "name of the vessel in Signal K, urn:mrn:imo:mmsi:NUMBER or urn:mrn:signalk:uuid:UUID; "
                 "without it one that is derived from this machine")
      ->check(CLI::Validator(problem_of_vessel, "NAME"));
  app.add_option("--mqtt", options.mqtt.broker,
                 "publishes to this MQTT broker; the port is 1883 unless it is given")
      ->check(CLI::Validator(broker_problem, "HOST[:PORT]"));
  app.add_option("--mqtt-topic-prefix", options.mqtt.prefix, "beginning of all MQTT topics")
      ->check(CLI::Validator(problem_of_prefix, "PREFIX"))
      ->capture_default_str();
  app.add_option("--mqtt-login-file", options.mqtt.login_file,
                 "file with the user of the broker in the first line and the password in the second");
  app.add_option("--mqtt-rate", options.mqtt.rate_Hz,
                 "most messages a second of each MQTT topic; events come at once")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--chrony", options.chrony_socket,
                 "hands UTC from GPS to chronyd on this machine: path of the socket of its refclock SOCK");
}

void check_outlet_options(const OutletOptions& options, std::string_view status) {
  const auto host = status.substr(0, status.rfind(':'));
  const bool is_here = host.empty() || host == "localhost" || host == "[::1]" || host.starts_with("127.");
  if (!options.chrony_socket.empty() && !is_here)
    throw CLI::ValidationError("--chrony", "needs a navcald on this machine, by the clock of which it measures");
}

}  // namespace navcal::web

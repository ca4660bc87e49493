// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/interruptible.h"
#include "base/service_manager.h"
#include "share/manual.h"
#include "web/access.h"
#include "web/control_peer.h"
#include "web/foxglove/peer.h"
#include "web/hub.h"
#include "web/listener.h"
#include "web/live_source.h"
#include "web/log_history.h"
#include "web/outlets/mavlink.h"
#include "web/outlets/mqtt_topics.h"
#include "web/outlets/outlet_options.h"
#include "web/outlets/outlets.h"
#include "web/outlets/signalk.h"
#include "web/page.h"
#include "web/server.h"
#include "web/site.h"

namespace navcal::web {
const char* option_texts();  // options.txt
}

namespace {

namespace asio = boost::asio;
namespace web = navcal::web;

struct Options {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;
  std::string status = "127.0.0.1:2947";
  std::string control = "/run/navcal/control";
  std::string token_file;
  std::string track;
  std::vector<std::string> host_names, origins;
  web::OutletOptions outlets{.version = NAVCAL_VERSION};
};

void add_outlet_options(CLI::App& app, web::OutletOptions& options) {
  const auto broker_problem = [](const std::string& text) {
    return web::mqtt_broker(text) ? std::string() : std::string("wants HOST or HOST:PORT");
  };
  app.add_option("--vessel", options.vessel)->check(CLI::Validator(web::problem_of_vessel, "NAME"));
  app.add_option("--mqtt", options.mqtt.broker)->check(CLI::Validator(broker_problem, "HOST[:PORT]"));
  app.add_option("--mqtt-topic-prefix", options.mqtt.prefix)
      ->check(CLI::Validator(web::problem_of_prefix, "PREFIX"))
      ->capture_default_str();
  app.add_option("--mqtt-login-file", options.mqtt.login_file);
  app.add_option("--mqtt-rate", options.mqtt.rate_Hz)->check(CLI::Range(0.01, 100.0))->capture_default_str();
  app.add_option("--chrony", options.chrony_socket);
}

void add_mavlink_options(CLI::App& app, web::MavlinkOptions& options) {
  app.add_option("--mavlink", options.address)->check(CLI::Validator(web::problem_of_mavlink_address, "ADDRESS"));
  const auto add = [&app](const char* name, auto& value, const CLI::Validator& check) {
    app.add_option(name, value)->check(check)->capture_default_str();
  };
  add("--mavlink-baud", options.baud, CLI::Range(50, 4'000'000));
  add("--mavlink-odometry-rate", options.odometry_Hz, CLI::Range(10.0, 20.0) | CLI::Range(0.0, 0.0));
  add("--mavlink-gps-rate", options.gps_Hz, CLI::Range(0.0, 20.0));
  add("--mavlink-values-rate", options.values_Hz, CLI::Range(0.0, 20.0));
  app.add_flag("--mavlink-texts,!--no-mavlink-texts", options.has_texts);
  add("--mavlink-system", options.system, CLI::Range(1, 255));
  add("--mavlink-component", options.component, CLI::Range(1, 255));
  add("--mavlink-tilt-std", options.tilt_std_deg, CLI::Range(0.0, 90.0));
  app.add_option("--mavlink-key-file", options.key_file);
}

/// Throws CLI::ValidationError for options that do not fit `status`, where navcald is.
void check_outlet_options(const web::OutletOptions& options, std::string_view status) {
  const auto host = status.substr(0, status.rfind(':'));
  const bool is_here = host.empty() || host == "localhost" || host == "[::1]" || host.starts_with("127.");
  for (const auto& [name, value] :
       {std::pair("--chrony", &options.chrony_socket), std::pair("--mavlink", &options.mavlink.address)})
    if (!value->empty() && !is_here)
      throw CLI::ValidationError(name, "needs a navcald on this machine, by the clock of which it measures");
}

void add_options(CLI::App& app, Options& options) {
  app.set_version_flag("--version", "navcal-web " NAVCAL_VERSION);
  app.add_option("--port", options.port)->capture_default_str();
  app.add_option("--address", options.address)->capture_default_str();
  app.add_option("--status", options.status)->capture_default_str()->check([](const std::string& text) {
    return web::status_socket(text) ? "" : "wants HOST:PORT";
  });
  app.add_option("--control", options.control)->capture_default_str();
  app.add_option("--token-file", options.token_file);
  app.add_option("--host-name", options.host_names)->take_all()->allow_extra_args(false);
  app.add_option("--allow-origin", options.origins)->take_all()->allow_extra_args(false);
  app.add_option("--track", options.track)->check(CLI::ExistingFile);
  add_outlet_options(app, options.outlets);
  add_mavlink_options(app, options.outlets.mavlink);
  navcal::share::set_help(app, web::option_texts());
}

void run(const Options& options) {
  // Clients that are still connected at the end go with the context, and use these three when they go.
  const web::Access access(options.token_file.empty() ? "" : web::read_token(options.token_file),
                           options.host_names, options.origins);
  web::Hub hub;
  web::Site site;
  // One thread runs everything. Asio's locks stay, because names are resolved on a thread of Asio's own: without
  // locks every resolution fails.
  asio::io_context context(1);
  asio::signal_set signals(context);
  for (const int signal : navcal::base::ending_signals()) signals.add(signal);
  const auto source =
      std::make_shared<web::LiveSource>(context.get_executor(), *web::status_socket(options.status), hub);
  web::Outlets outlets(context.get_executor(), options.outlets, hub, site);
  site.add(web::control_endpoint(context.get_executor(), "/control", options.control, access));
  web::LogHistory history(context.get_executor(), options.control);
  web::add_history(site, history);
  site.add(web::foxglove::endpoint(hub, NAVCAL_VERSION));
  web::PageFeed::Settings page_settings{.version = NAVCAL_VERSION, .can_change = access.can_change()};
  const auto page = web::add_page(site, context.get_executor(), hub, std::move(page_settings), options.track);
  const auto server = std::make_shared<web::Server>(
      web::listen(context.get_executor(), options.address, options.port), site, access);
  outlets.watch(server->counters(), source->counters());
  signals.async_wait([&](boost::system::error_code error, int) {
    if (error) return;
    navcal::base::notify_manager("STOPPING=1", navcal::base::IfBusy::wait);
    outlets.stop();
    source->stop();
    server->stop();
    // What clients have not taken by now is not waited for.
    context.stop();
  });
  source->start();
  server->start();
  std::printf("navcal-web: http://%s:%u/\n", options.address.c_str(), static_cast<unsigned>(server->port()));
  std::fflush(stdout);
  navcal::base::notify_manager("READY=1", navcal::base::IfBusy::wait);
  context.run();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"navcal-web: shows a running navcald in the browser, and serves it to other programs",
               "navcal-web"};
  add_options(app, options);
  return navcal::share::run_program(
      app, argc, argv, [&] { run(options); }, [&] { check_outlet_options(options.outlets, options.status); });
}

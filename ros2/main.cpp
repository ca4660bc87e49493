// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <cstdio>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/interruptible.h"
#include "base/service_manager.h"
#include "ros2/dds.h"
#include "ros2/intake.h"
#include "ros2/publisher.h"
#include "share/manual.h"
#include "web/hub.h"
#include "web/live_source.h"

namespace {

namespace ros2 = navcal::ros2;
namespace web = navcal::web;
using navcal::record::RosAxes;

enum Exit : int { kStopped = 0, kCannotStart = 1, kUsage = 2 };

struct Options {
  std::uint32_t domain = 0;
  std::string name_space = "/navcal", status = "127.0.0.1:2947", samples = "/run/navcal/samples";
  std::vector<std::string> in;
  bool tf = false, ned = false;
};

/// The exit status when the command line has said it all: help, version, or a mistake.
std::optional<int> parse(int argc, char** argv, Options& options) {
  CLI::App app{"navcal-ros2: topics of ROS 2 for navcald, without ROS", "navcal-ros2"};
  app.set_version_flag("--version", "navcal-ros2 " NAVCAL_VERSION);
  constexpr int kLastDomain = 232;
  app.add_option("--domain", options.domain, "domain of ROS 2")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, kLastDomain))
      ->capture_default_str();
  app.add_option("--namespace", options.name_space, "beginning of the names of topics")
      ->check([](const std::string& text) { return ros2::is_topic(text) ? "" : "wants /NAME"; })
      ->capture_default_str();
  app.add_option("--status", options.status, "status socket of navcald, HOST:PORT")
      ->check([](const std::string& text) { return web::status_socket(text) ? "" : "wants HOST:PORT"; })
      ->capture_default_str();
  const std::string form = std::string("KIND=/TOPIC with a kind of ") + ros2::kKinds;
  app.add_option("--in", options.in, "topic whose messages become samples, " + form + "; may be repeated")
      ->take_all()
      ->allow_extra_args(false)
      ->check([&](const std::string& text) { return ros2::read_source(text) ? "" : "wants " + form; });
  app.add_option("--samples", options.samples, "Unix socket of navcald's port with the protocol samples, for --in")
      ->capture_default_str();
  app.add_flag("--tf", options.tf, "sends the pose of the odometry on /tf, too");
  app.add_flag("--ned", options.ned,
               "forward, starboard, down and north, east, down instead of the axes of REP 103");
  app.footer("Example: navcal-ros2 --domain 3 --tf --in imu=/imu/data, then `ros2 topic echo /navcal/odometry`");
  navcal::share::add_manual(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kStopped : kUsage;
  }
  return std::nullopt;
}

void run(const Options& options) {
  web::Hub hub;
  // One thread of ours. Asio's locks stay: names are resolved, and messages come, on threads of others.
  boost::asio::io_context context(1);
  boost::asio::signal_set signals(context);
  for (const int signal : navcal::base::ending_signals()) signals.add(signal);
  std::list<ros2::Source> sources;
  for (const std::string& text : options.in) sources.push_back(*ros2::read_source(text));
  ros2::Intake intake(context.get_executor(), options.samples, std::move(sources));
  const auto source =
      std::make_shared<web::LiveSource>(context.get_executor(), *web::status_socket(options.status), hub);
  ros2::Participant participant(options.domain);
  ros2::Publisher publisher(participant, hub, options.name_space, options.ned ? RosAxes::ned : RosAxes::rep103,
                            options.tf);
  signals.async_wait([&](boost::system::error_code error, int) {
    if (error) return;
    navcal::base::notify_manager("STOPPING=1", navcal::base::IfBusy::wait);
    source->stop();
    context.stop();
  });
  intake.start(participant);
  source->start();
  fmt::print("navcal-ros2: domain {}, topics {}/...\n", options.domain, options.name_space);
  std::fflush(stdout);
  navcal::base::notify_manager("READY=1", navcal::base::IfBusy::wait);
  context.run();
  fmt::print("navcal-ros2: {}; {}\n", publisher.summary(), intake.summary());
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (const auto status = parse(argc, argv, options)) return *status;
  try {
    run(options);
    return kStopped;
  } catch (const std::exception& error) {
    fmt::print(stderr, "navcal-ros2: cannot start: {}\n", error.what());
    return kCannotStart;
  }
}

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <cstdint>
#include <cstdio>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/interruptible.h"
#include "base/service_manager.h"
#include "protocols/ros2/cdr_reader.h"
#include "protocols/ros2/cdr_writer.h"
#include "record/ros2/sample_messages.h"
#include "ros2/dds.h"
#include "ros2/intake.h"
#include "share/manual.h"
#include "web/hub.h"
#include "web/live_source.h"

namespace {

namespace ros2 = navcal::ros2;
namespace web = navcal::web;
namespace messages = navcal::protocols::ros2;
using navcal::record::RosAxes;

struct Options {
  std::uint32_t domain = 0;
  std::string name_space = "/navcal", status = "127.0.0.1:2947", samples = "/run/navcal/samples";
  std::vector<std::string> in;
  bool tf = false, ned = false;
};

constexpr std::string_view kOurs = "/navcal/";

/// The pose as a transform from the frame of the odometry to the body.
messages::TransformMessage transform_of(const messages::Odometry& odometry) {
  const auto& [x, y, z] = odometry.pose.pose.position;
  return {{{odometry.header, odometry.child_frame_id, {{x, y, z}, odometry.pose.pose.orientation}}}};
}

/// Publishes the records of navcald (docs/ros2.md), with the time of validity as their stamp. While UTC is unknown
/// there are none. A topic is there from its first message on.
class Publisher final : public web::Subscriber {
 public:
  /// `name_space` takes the place of "/navcal" in the names. `tf`: the pose of the odometry goes on /tf, too.
  Publisher(ros2::Participant& participant, web::Hub& hub, std::string name_space, navcal::record::RosAxes axes,
            bool tf);
  ~Publisher() override { hub_.remove(*this); }
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  void on_record(const web::Record& record) override;
  void on_link(const web::Link& link) override;
  /// "published 4711 messages on 7 topics, 0 lost, 0 without UTC".
  [[nodiscard]] std::string summary() const;

 private:
  void publish(const std::string& topic, const navcal::protocols::ros2::MessageType& type, std::string_view cdr);

  ros2::Participant& participant_;
  web::Hub& hub_;
  std::string name_space_;
  navcal::record::SampleMessages messages_;
  bool tf_;
  std::map<std::string, ros2::Participant::Handle> writers_;  ///< by topic
  std::uint64_t published_ = 0, lost_ = 0, without_utc_ = 0;
  std::string told_;
};

Publisher::Publisher(ros2::Participant& participant, web::Hub& hub, std::string name_space,
                     navcal::record::RosAxes axes, bool tf)
    : participant_(participant), hub_(hub), name_space_(std::move(name_space)), messages_(axes), tf_(tf) {
  hub_.add(*this, {false,
                   {"/imu", "/compass", "/gps", "/depth", "/dvl", "/altimeter", "/power", "/battery", "/sensor",
                    "/nav", "/health", "/event"},
                   std::nullopt});
}

void Publisher::on_link(const web::Link& link) {
  const std::string now = link.problem.empty() ? "connected to navcald" : link.problem;
  if (std::exchange(told_, now) != now) fmt::print(stderr, "navcal-ros2: {}\n", now);
}

void Publisher::on_record(const web::Record& record) {
  if (!record.utc_ns) {
    ++without_utc_;
    return;
  }
  for (navcal::record::RosMessage& message : messages_.made_of(record.topic, record.message, *record.utc_ns)) {
    if (message.topic.starts_with(kOurs)) message.topic.replace(0, kOurs.size() - 1, name_space_);
    publish(message.topic, *message.type, message.cdr);
    if (!tf_ || record.topic != "/nav") continue;
    if (const auto odometry = messages::decode<messages::Odometry>(message.cdr))
      publish("/tf", *messages::written_type(messages::full_name(messages::TransformMessage::kType)),
              messages::encode(transform_of(*odometry)));
  }
}

void Publisher::publish(const std::string& topic, const messages::MessageType& type, std::string_view cdr) {
  const auto [writer, is_new] = writers_.try_emplace(topic);
  if (is_new) writer->second = participant_.add_writer(topic, type);
  ++(ros2::Participant::write(writer->second, cdr) ? published_ : lost_);
}

std::string Publisher::summary() const {
  return fmt::format("published {} messages on {} topics, {} lost, {} without UTC", published_, writers_.size(),
                     lost_, without_utc_);
}

void add_options(CLI::App& app, Options& options) {
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
  static const std::string form = std::string("KIND=/TOPIC with a kind of ") + ros2::kKinds;
  app.add_option("--in", options.in, "topic whose messages become samples, " + form + "; may be repeated")
      ->take_all()
      ->allow_extra_args(false)
      ->check([](const std::string& text) { return ros2::read_source(text) ? "" : "wants " + form; });
  app.add_option("--samples", options.samples, "Unix socket of navcald's port with the protocol samples, for --in")
      ->capture_default_str();
  app.add_flag("--tf", options.tf, "sends the pose of the odometry on /tf, too");
  app.add_flag("--ned", options.ned,
               "forward, starboard, down and north, east, down instead of the axes of REP 103");
  app.footer("Example: navcal-ros2 --domain 3 --tf --in imu=/imu/data, then `ros2 topic echo /navcal/odometry`");
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
  Publisher publisher(participant, hub, options.name_space, options.ned ? RosAxes::ned : RosAxes::rep103,
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
  CLI::App app{"navcal-ros2: topics of ROS 2 for navcald, without ROS", "navcal-ros2"};
  add_options(app, options);
  return navcal::share::run_program(app, argc, argv, [&] { run(options); });
}

// SPDX-License-Identifier: Apache-2.0
#include "ros2/publisher.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "protocols/ros2/cdr_reader.h"
#include "protocols/ros2/cdr_writer.h"

namespace navcal::ros2 {
namespace messages = protocols::ros2;
namespace {

constexpr std::string_view kOurs = "/navcal/";

/// The pose as a transform from the frame of the odometry to the body.
messages::TransformMessage transform_of(const messages::Odometry& odometry) {
  const auto& [x, y, z] = odometry.pose.pose.position;
  return {{{odometry.header, odometry.child_frame_id, {{x, y, z}, odometry.pose.pose.orientation}}}};
}

}  // namespace

Publisher::Publisher(Participant& participant, web::Hub& hub, std::string name_space, record::RosAxes axes,
                     bool tf)
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
  for (record::RosMessage& message : messages_.made_of(record.topic, record.message, *record.utc_ns)) {
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
  ++(Participant::write(writer->second, cdr) ? published_ : lost_);
}

std::string Publisher::summary() const {
  return fmt::format("published {} messages on {} topics, {} lost, {} without UTC", published_, writers_.size(),
                     lost_, without_utc_);
}

}  // namespace navcal::ros2

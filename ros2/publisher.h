// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "record/ros2/sample_messages.h"
#include "ros2/dds.h"
#include "web/hub.h"

namespace navcal::ros2 {

/// Publishes the records of navcald (docs/ros2.md), with the time of validity as their stamp. While UTC is unknown
/// there are none. A topic is there from its first message on.
class Publisher final : public web::Subscriber {
 public:
  /// `name_space` takes the place of "/navcal" in the names. `tf`: the pose of the odometry goes on /tf, too.
  Publisher(Participant& participant, web::Hub& hub, std::string name_space, record::RosAxes axes, bool tf);
  ~Publisher() override { hub_.remove(*this); }
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  void on_record(const web::Record& record) override;
  void on_link(const web::Link& link) override;
  /// "published 4711 messages on 7 topics, 0 lost, 0 without UTC".
  [[nodiscard]] std::string summary() const;

 private:
  void publish(const std::string& topic, const protocols::ros2::MessageType& type, std::string_view cdr);

  Participant& participant_;
  web::Hub& hub_;
  std::string name_space_;
  record::SampleMessages messages_;
  bool tf_;
  std::map<std::string, Participant::Handle> writers_;  ///< by topic
  std::uint64_t published_ = 0, lost_ = 0, without_utc_ = 0;
  std::string told_;
};

}  // namespace navcal::ros2

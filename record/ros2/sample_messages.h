// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/local_plane.h"
#include "protocols/ros2/ros_messages.h"
#include "record/json/flat_json.h"

namespace navcal::record {

/// Axes of the messages: of REP 103 (body forward, left, up; world east, north, up), or navcal's own (forward,
/// starboard, down; north, east, down). Frames are "base_link" and "odom", or "base_link_frd" and "odom_ned".
enum class RosAxes : std::uint8_t { rep103, ned };

struct RosMessage {
  std::string topic;  ///< "/navcal/imu/data"
  const protocols::ros2::MessageType* type = nullptr;
  std::int64_t stamp_ns = 0;  ///< of its header, UTC
  std::string cdr;
};

/// Makes messages of ROS 2 of the JSON messages that log and status socket have (docs/export.md). A member that is
/// absent has no message, or is marked as absent in it; an error that is unknown is never stated. A heading
/// becomes a yaw only if it is from true north: of an estimate that is told by /health, /event, /config and
/// /compass.
class SampleMessages {
 public:
  explicit SampleMessages(RosAxes axes = RosAxes::rep103) : axes_(axes) {}

  /// Those of one message of a topic of the log ("/imu"), which is valid at `utc_ns`. Without UTC there is nothing
  /// to be said: such messages are not for this. Empty for topics without a type in ROS.
  [[nodiscard]] std::vector<RosMessage> made_of(std::string_view topic, std::string_view json,
                                                std::int64_t utc_ns);

 private:
  void learn_north(std::string_view topic, const FlatJson& json);

  RosAxes axes_;
  std::optional<base::LocalPlane> origin_;  ///< of "odom": the first position
  bool knows_declination_ = false, has_true_heading_ = false, has_magnetic_heading_ = false;
};

}  // namespace navcal::record

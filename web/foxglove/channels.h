// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/local_plane.h"
#include "record/ros2/sample_messages.h"
#include "web/hub.h"
#include "web/record.h"

namespace navcal::web::foxglove {

/// The JSON schemas of Foxglove that navcal writes: a list, each with its name as `title`.
[[nodiscard]] const char* schemas_json();

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};
/// Turns vectors of "vehicle" into those of "map". Radians: heading clockwise from north, pitch nose up, roll
/// starboard down.
[[nodiscard]] Quaternion orientation_in_map(double heading_rad, double pitch_rad, double roll_rad);

/// What one record gives; absent where it gives none.
struct Derived {
  std::optional<std::string> location;   ///< foxglove.LocationFix
  std::optional<std::string> pose;       ///< foxglove.PoseInFrame
  std::optional<std::string> transform;  ///< foxglove.FrameTransform
  std::optional<std::string> log;        ///< foxglove.Log
};

/// Standard error that stands for an unknown one, m: so large that no filter is led by the value.
inline constexpr double kUnknownStd_m = 1e6;

class Deriver {
 public:
  /// `time_ns`: time of validity, UTC. A record that is no JSON object, or of another topic, gives nothing.
  [[nodiscard]] Derived derive(const Record& record, std::int64_t time_ns);

 private:
  /// East and north of the origin, m. The first place becomes the origin, and so does one that is far from it.
  [[nodiscard]] std::array<double, 2> position_in_map(double latitude_deg, double longitude_deg);

  std::optional<base::LocalPlane> origin_;
};

/// A stream of messages that viewers may subscribe to.
struct Channel {
  std::uint32_t id = 0;
  std::vector<std::string> sources;  ///< topics of records from which its messages are made
  /// Member of Derived that it has; null: the messages are those of the records.
  std::optional<std::string> Derived::*member = nullptr;
  std::string ros_topic{};     ///< not empty: its messages are those of this topic of ROS, in CDR
  std::string announcement{};  ///< for advertise()
};

/// The channels of all viewers. A channel keeps its id as long as the program runs, because viewers keep what they
/// know of it by its id; another schema makes another channel.
class Channels {
 public:
  /// Those that can be had from these topics. The pointers stay valid.
  [[nodiscard]] std::vector<const Channel*> available(const std::vector<Topic>& topics);

  /// Adds the channels of ROS that `record` has messages for: their topics carry names of ports, which no list of
  /// topics tells. How many there are.
  std::size_t learn_ros(const Record& record, std::uint64_t serial);

  /// Message of `record` for `channel`; the view holds until the next call. Nullopt: the record gives none.
  /// `serial` numbers the records: what is derived from one is kept for the next viewer.
  [[nodiscard]] std::optional<std::string_view> message(const Channel& channel, const Record& record,
                                                        std::int64_t time_ns, std::uint64_t serial);

 private:
  Channel* known(Channel channel, const std::string& topic, const std::string& schema_name,
                 const std::string& schema);
  /// Makes the messages of ROS of this record, unless it is the one of before.
  void turn_to(const Record& record, std::uint64_t serial);

  std::map<std::tuple<std::string, std::string, std::string>, Channel> channels_;
  std::vector<Channel*> ros_;
  Deriver deriver_;
  record::SampleMessages samples_;
  // Made of the newest record: `made_from_` is its topic and device, `made_serial_` its number.
  std::vector<record::RosMessage> ros_made_;  ///< as in a bag of ROS 2; none while UTC is unknown
  std::optional<Derived> derived_;            ///< once a viewer has asked
  std::string made_from_;
  std::uint64_t made_serial_ = 0;
};

}  // namespace navcal::web::foxglove

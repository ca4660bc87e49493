// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "record/log/log_topics.h"

namespace navcal::record {

/// Topic of the mission sensors. Its tables have the position too (sensor_places.h).
inline constexpr std::string_view kSensorTopic = "/sensor";

/// One column of a table of a topic's messages.
struct TopicColumn {
  std::string title;   ///< with its unit: "heading_rad", "lat_deg", "rate_rad_s_x"
  std::string member;  ///< of the message, as FlatJson names it: "rate_rad_s.0"
  const Field* field = nullptr;
};

/// Columns of a topic with listed members; a vector becomes three, _x _y _z, or _1 _2 _3 of fins.
[[nodiscard]] std::vector<TopicColumn> topic_columns(const Topic& topic);

/// Name of a topic in tables: "imu" for "/imu", "raw_compass" for "/raw/compass".
[[nodiscard]] std::string table_name(std::string_view topic);

/// Null where a topic's messages are kept as whole JSON: they have more members than are listed.
[[nodiscard]] const Topic* listed_topic(std::string_view name);

}  // namespace navcal::record

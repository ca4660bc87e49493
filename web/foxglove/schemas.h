// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// JSON schemas of the messages that Foxglove's panels know by name, with the members that navcal fills
/// (https://docs.foxglove.dev/docs/visualization/message-schemas/introduction).
namespace navcal::web::foxglove {

[[nodiscard]] std::string location_fix_schema();
[[nodiscard]] std::string pose_in_frame_schema();
[[nodiscard]] std::string frame_transform_schema();
[[nodiscard]] std::string log_schema();

}  // namespace navcal::web::foxglove

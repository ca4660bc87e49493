// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace navcal::analysis::ros {

/// Numbers of one message of commands or of joints.
struct CommandValues {
  std::int64_t stamp_ns = 0;  ///< of its header; 0: it has none
  /// By the name of the member as a map has it: "data", "data[1]", "channels[0]", "rudder/position".
  std::vector<std::pair<std::string, double>> values;
  /// The numbers are pulses in us, which are samples also without a map.
  bool are_pulses = false;
};

/// Whether messages of this type are read: std_msgs Float32, Float64 and their arrays, mavros_msgs/RCOut,
/// sensor_msgs/JointState.
[[nodiscard]] bool has_commands(std::string_view type);

/// nullopt when the message is shorter than its type.
[[nodiscard]] std::optional<CommandValues> decode_commands(std::string_view type, std::string_view cdr);

}  // namespace navcal::analysis::ros

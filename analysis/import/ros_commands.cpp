// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/ros_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "protocols/ros2/cdr_reader.h"
#include "protocols/ros2/ros_messages.h"

namespace navcal::analysis::ros {
namespace {

namespace ros2 = protocols::ros2;

template <class T>
void take_list(const std::vector<T>& numbers, std::string_view name, CommandValues& found) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    found.values.emplace_back(fmt::format("{}[{}]", name, i), static_cast<double>(numbers[i]));
}

template <class T>
void take(const ros2::Number<T>& number, CommandValues& found) {
  found.values.emplace_back("data", static_cast<double>(number.data));
}

template <class T>
void take(const ros2::NumberArray<T>& array, CommandValues& found) {
  take_list(array.data, "data", found);
}

void take(const ros2::RcOut& outputs, CommandValues& found) {
  found.are_pulses = true;
  found.stamp_ns = outputs.header.stamp_ns();
  take_list(outputs.channels, "channels", found);
}

void take(const ros2::JointState& joints, CommandValues& found) {
  found.stamp_ns = joints.header.stamp_ns();
  const auto take_of = [&](const std::vector<double>& values, std::string_view quantity) {
    for (std::size_t i = 0; i < std::min(values.size(), joints.name.size()); ++i)
      found.values.emplace_back(fmt::format("{}/{}", joints.name[i], quantity), values[i]);
  };
  take_of(joints.position, "position");
  take_of(joints.velocity, "velocity");
  take_of(joints.effort, "effort");
}

struct CommandType {
  std::string name;
  std::optional<CommandValues> (*decode)(std::string_view cdr);
};
template <class Message>
CommandType type_with_commands() {
  return {ros2::full_name(Message::kType), [](std::string_view cdr) -> std::optional<CommandValues> {
            const auto message = ros2::decode<Message>(cdr);
            if (!message) return std::nullopt;
            CommandValues found;
            take(*message, found);
            return found;
          }};
}

const CommandType* command_type(std::string_view name) {
  static const std::array kCommandTypes{type_with_commands<ros2::Number<float>>(),
                                        type_with_commands<ros2::Number<double>>(),
                                        type_with_commands<ros2::NumberArray<float>>(),
                                        type_with_commands<ros2::NumberArray<double>>(),
                                        type_with_commands<ros2::RcOut>(),
                                        type_with_commands<ros2::JointState>()};
  const auto found = std::find_if(kCommandTypes.begin(), kCommandTypes.end(),
                                  [&](const CommandType& type) { return type.name == name; });
  return found == kCommandTypes.end() ? nullptr : &*found;
}

}  // namespace

bool has_commands(std::string_view type) { return command_type(type) != nullptr; }

std::optional<CommandValues> decode_commands(std::string_view type, std::string_view cdr) {
  const CommandType* const known = command_type(type);
  return known == nullptr ? std::nullopt : known->decode(cdr);
}

}  // namespace navcal::analysis::ros

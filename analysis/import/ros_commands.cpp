// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/ros_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "analysis/import/cdr_reader.h"

namespace navcal::analysis::ros {
namespace {

template <class T>
void read_list(CdrReader& reader, std::string_view name, CommandValues& found) {
  const std::size_t count = reader.take_count(sizeof(T));
  for (std::size_t i = 0; i < count; ++i)
    found.values.emplace_back(fmt::format("{}[{}]", name, i), static_cast<double>(reader.take<T>()));
}

template <class T>
void read_number(CdrReader& reader, CommandValues& found) {
  found.values.emplace_back("data", static_cast<double>(reader.take<T>()));
}

/// std_msgs/MultiArrayLayout (label, size and stride of each dimension; offset of the data), then the list.
template <class T>
void read_array(CdrReader& reader, CommandValues& found) {
  constexpr std::size_t kLeastDimension = 12;
  const std::size_t dimensions = reader.take_count(kLeastDimension);
  for (std::size_t i = 0; i < dimensions; ++i) {
    reader.skip_text();
    (void)reader.take<std::uint32_t>();
    (void)reader.take<std::uint32_t>();
  }
  (void)reader.take<std::uint32_t>();
  read_list<T>(reader, "data", found);
}

void read_outputs(CdrReader& reader, CommandValues& found) {
  found.are_pulses = true;
  found.stamp_ns = reader.take_header();
  read_list<std::uint16_t>(reader, "channels", found);
}

/// Names, then positions (rad, m), velocities and efforts in the order of the names; each list may be empty.
void read_joints(CdrReader& reader, CommandValues& found) {
  constexpr std::size_t kLeastText = 4;
  found.stamp_ns = reader.take_header();
  std::vector<std::string> names(reader.take_count(kLeastText));
  for (std::string& name : names) name = reader.take_text();
  for (const std::string_view what : {"position", "velocity", "effort"}) {
    const std::size_t count = reader.take_count(sizeof(double));
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = reader.take<double>();
      if (i < names.size()) found.values.emplace_back(fmt::format("{}/{}", names[i], what), value);
    }
  }
}

struct CommandType {
  std::string_view name;
  void (*read)(CdrReader&, CommandValues&);
};
constexpr std::array kCommandTypes{CommandType{"std_msgs/msg/Float32", read_number<float>},
                                   CommandType{"std_msgs/msg/Float64", read_number<double>},
                                   CommandType{"std_msgs/msg/Float32MultiArray", read_array<float>},
                                   CommandType{"std_msgs/msg/Float64MultiArray", read_array<double>},
                                   CommandType{"mavros_msgs/msg/RCOut", read_outputs},
                                   CommandType{"sensor_msgs/msg/JointState", read_joints}};

const CommandType* command_type(std::string_view name) {
  const auto found = std::find_if(kCommandTypes.begin(), kCommandTypes.end(),
                                  [&](const CommandType& type) { return type.name == name; });
  return found == kCommandTypes.end() ? nullptr : &*found;
}

}  // namespace

bool has_commands(std::string_view type) { return command_type(type) != nullptr; }

std::optional<CommandValues> decode_commands(std::string_view type, std::string_view cdr) {
  const CommandType* const known = command_type(type);
  if (known == nullptr) return std::nullopt;
  CdrReader reader(cdr);
  CommandValues found;
  known->read(reader, found);
  return reader.is_good() ? std::optional(std::move(found)) : std::nullopt;
}

}  // namespace navcal::analysis::ros

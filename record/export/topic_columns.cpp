// SPDX-License-Identifier: Apache-2.0
#include "record/export/topic_columns.h"

#include <array>

namespace navcal::record {

std::vector<TopicColumn> topic_columns(const Topic& topic) {
  // SensorPlaces adds these to a sample.
  static const std::array kSensorPlace{sample_field("lat"), sample_field("lon")};
  constexpr std::array<std::string_view, 3> kAxes{"_x", "_y", "_z"};
  constexpr std::array<std::string_view, 3> kFins{"_1", "_2", "_3"};
  std::vector<TopicColumn> columns;
  const auto add = [&](const Field& field) {
    const std::string name(field.name);
    columns.push_back({field.unit.empty() ? name : name + "_" + std::string(field.unit), name, &field});
  };
  for (const Field& field : topic.fields) {
    const std::string name(field.name);
    if (field.kind == FieldKind::vector3) {
      const auto& endings = field.name.starts_with("fins") ? kFins : kAxes;
      for (std::size_t i = 0; i < endings.size(); ++i) {
        columns.push_back({name + std::string(endings[i]), name + "." + std::to_string(i), &field});
      }
    } else {
      add(field);
    }
  }
  if (topic.name == kSensorTopic) {
    for (const Field& field : kSensorPlace) add(field);
  }
  return columns;
}

std::string table_name(std::string_view topic) {
  const std::size_t begin = topic.find_first_not_of('/');
  std::string name(begin == std::string_view::npos ? std::string_view{} : topic.substr(begin));
  for (char& c : name) {
    if (c == '/') c = '_';
  }
  return name;
}

const Topic* listed_topic(std::string_view name) {
  const Topic* const topic = json_topic(name);
  return topic != nullptr && topic->fields.size() > 1 ? topic : nullptr;
}

}  // namespace navcal::record

// SPDX-License-Identifier: Apache-2.0
#include "daemon/record_topics.h"

#include <fmt/format.h>

#include "record/log/log_topics.h"

namespace navcal::daemon {

RecordTopics RecordTopics::all() {
  RecordTopics topics;
  for (const record::Topic& topic : record::json_topics()) {
    if (topic.id != record::topic::kConfig) topics.bits_ |= 1U << topic.id;
  }
  return topics;
}

bool RecordTopics::add(std::string_view name) {
  const record::Topic* topic = record::json_topic(name);
  if (topic == nullptr || !all().has(topic->id)) return false;
  bits_ |= 1U << topic->id;
  return true;
}

std::vector<std::string> RecordTopics::names() const {
  std::vector<std::string> names;
  for (const record::Topic& topic : record::json_topics()) {
    if (has(topic.id)) names.emplace_back(topic.name);
  }
  return names;
}

std::string RecordTopics::text() const { return fmt::format("{}", fmt::join(names(), ", ")); }

}  // namespace navcal::daemon

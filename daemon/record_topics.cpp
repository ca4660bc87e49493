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

bool RecordIntervals::set(std::string_view name, std::int64_t interval_ns) {
  const record::Topic* topic = record::json_topic(name);
  if (topic == nullptr || !RecordTopics::all().has(topic->id)) return false;
  intervals_ns_.at(topic->id) = interval_ns;
  return true;
}

std::optional<std::int64_t> RecordIntervals::of(std::uint16_t topic) const {
  return topic < intervals_ns_.size() ? intervals_ns_[topic] : std::nullopt;
}

std::vector<std::pair<std::string, std::int64_t>> RecordIntervals::chosen() const {
  std::vector<std::pair<std::string, std::int64_t>> chosen;
  for (const record::Topic& topic : record::json_topics()) {
    if (const auto interval_ns = of(topic.id)) chosen.emplace_back(topic.name, *interval_ns);
  }
  return chosen;
}

std::string RecordTopics::text() const { return fmt::format("{}", fmt::join(names(), ", ")); }

}  // namespace navcal::daemon

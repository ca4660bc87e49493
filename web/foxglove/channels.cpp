// SPDX-License-Identifier: Apache-2.0
#include "web/foxglove/channels.h"

#include <algorithm>

#include "web/foxglove/protocol.h"
#include "web/foxglove/schemas.h"

namespace navcal::web::foxglove {
namespace {

/// Bound of what is kept: a broken peer may name new topics without end.
constexpr std::size_t kMaxChannels = 1024;

struct DerivedChannel {
  const char* topic;
  const char* schema_name;
  std::string schema;
  std::vector<std::string> sources;
  std::optional<std::string> Derived::*member;
};

const std::vector<DerivedChannel>& derived_channels() {
  static const std::vector<DerivedChannel> channels{
      {"/foxglove/location", "foxglove.LocationFix", location_fix_schema(), {"/gps", "/nav"}, &Derived::location},
      {"/foxglove/pose", "foxglove.PoseInFrame", pose_in_frame_schema(), {"/nav"}, &Derived::pose},
      {"/foxglove/tf", "foxglove.FrameTransform", frame_transform_schema(), {"/nav"}, &Derived::transform},
      {"/foxglove/log", "foxglove.Log", log_schema(), {"/event"}, &Derived::log},
  };
  return channels;
}

}  // namespace

std::vector<const Channel*> Channels::available(const std::vector<Topic>& topics) {
  std::vector<const Channel*> found;
  const auto add = [&found](const Channel* channel) {
    if (channel != nullptr) found.push_back(channel);
  };
  for (const Topic& topic : topics)
    add(known({0, {topic.name}, nullptr, {}}, topic.name, topic.schema_name, topic.schema));
  for (const DerivedChannel& derived : derived_channels()) {
    const bool has_source = std::any_of(topics.begin(), topics.end(), [&](const Topic& topic) {
      return std::find(derived.sources.begin(), derived.sources.end(), topic.name) != derived.sources.end();
    });
    if (has_source)
      add(known({0, derived.sources, derived.member, {}}, derived.topic, derived.schema_name, derived.schema));
  }
  return found;
}

const Channel* Channels::known(Channel channel, const std::string& topic, const std::string& schema_name,
                               const std::string& schema) {
  const std::tuple key{topic, schema_name, schema};
  const auto found = channels_.find(key);
  if (found != channels_.end()) return &found->second;
  if (channels_.size() >= kMaxChannels) return nullptr;
  channel.id = static_cast<std::uint32_t>(channels_.size() + 1);
  channel.announcement = foxglove::channel(channel.id, topic, schema_name, schema);
  return &channels_.emplace(key, std::move(channel)).first->second;
}

std::optional<std::string_view> Channels::message(const Channel& channel, const Record& record,
                                                  std::int64_t time_ns, std::uint64_t serial) {
  if (channel.member == nullptr) return record.message;
  std::string from = std::string(record.topic) + ' ' + std::string(record.device);
  if (serial != derived_serial_ || from != derived_from_) {
    derived_ = deriver_.derive(record, time_ns);
    derived_serial_ = serial;
    derived_from_ = std::move(from);
  }
  const auto& made = derived_.*channel.member;
  return made ? std::optional<std::string_view>(*made) : std::nullopt;
}

}  // namespace navcal::web::foxglove

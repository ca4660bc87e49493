// SPDX-License-Identifier: Apache-2.0
#include "web/foxglove/channels.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "base/angles.h"
#include "web/foxglove/protocol.h"
#include "web/outlets/json_members.h"

namespace navcal::web::foxglove {
namespace {

using DerivedJson = nlohmann::ordered_json;

/// Largest distance from the origin. Further away the tangent plane is off by more than 1 %, so the origin moves
/// there.
constexpr double kMaxDistance_m = 50'000;
/// Colours that people with any colour vision tell apart (Okabe and Ito): orange for fixes, blue for what is
/// reckoned.
const DerivedJson kFixColour{{"r", 0.902}, {"g", 0.624}, {"b", 0.0}, {"a", 1.0}};
const DerivedJson kReckonedColour{{"r", 0.0}, {"g", 0.447}, {"b", 0.698}, {"a", 1.0}};

DerivedJson timestamp(std::int64_t time_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return {{"sec", time_ns / kSecond_ns}, {"nsec", time_ns % kSecond_ns}};
}

DerivedJson vector(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }

struct Place {
  double latitude_deg = 0, longitude_deg = 0;
};
std::optional<Place> place_in(const nlohmann::json& message) {
  const auto latitude = number_in(message, "lat"), longitude = number_in(message, "lon");
  if (!latitude || !longitude || std::abs(*latitude) > 90) return std::nullopt;
  return Place{*latitude, *longitude};
}

/// Standard errors, m, as a covariance with its type.
void put_covariance(DerivedJson& fix, std::optional<double> east_m, std::optional<double> north_m,
                    std::optional<double> up_m) {
  enum : int { unknown = 0, approximated = 1, diagonal_known = 2 };
  const auto variance = [](std::optional<double> std_m) {
    const double value = std_m.value_or(kUnknownStd_m);
    return value * value;
  };
  const bool known = east_m && north_m;
  fix["position_covariance"] =
      known ? std::array{variance(east_m), 0., 0., 0., variance(north_m), 0., 0., 0., variance(up_m)}
            : std::array<double, 9>{};
  fix["position_covariance_type"] = !known ? unknown : up_m ? diagonal_known : approximated;
}

DerivedJson location_fix(std::int64_t time_ns, std::string_view frame, const Place& place, double altitude_m) {
  return {{"timestamp", timestamp(time_ns)},
          {"frame_id", frame},
          {"latitude", place.latitude_deg},
          {"longitude", place.longitude_deg},
          {"altitude", altitude_m}};
}

DerivedJson metadata(std::initializer_list<std::pair<const char*, std::string>> pairs) {
  auto list = DerivedJson::array();
  for (const auto& [key, value] : pairs) list.push_back({{"key", key}, {"value", value}});
  return list;
}

std::optional<std::string> location_of_fix(const nlohmann::json& message, std::int64_t time_ns) {
  const auto place = place_in(message);
  const std::string kind = text_in(message, "fix");
  if (!place || kind == "none" || kind == "acquiring") return std::nullopt;
  const auto height_m = number_in(message, "height_m");
  DerivedJson fix = location_fix(time_ns, text_in(message, "device"), *place, height_m.value_or(0));
  const auto position_std_m = number_in(message, "position_std_m");
  put_covariance(fix, position_std_m, position_std_m,
                 height_m ? number_in(message, "height_std_m") : std::nullopt);
  const auto speed_m_s = number_in(message, "speed_m_s"), course_rad = number_in(message, "course_rad");
  if (speed_m_s && course_rad)
    fix["velocity"] = vector(*speed_m_s * std::sin(*course_rad), *speed_m_s * std::cos(*course_rad),
                             number_in(message, "climb_m_s").value_or(0));
  fix["color"] = kFixColour;
  fix["metadata"] = metadata({{"source", "/gps"}, {"fix", kind}});
  return json_text(fix);
}

std::string location_of_reckoning(const nlohmann::json& message, std::int64_t time_ns, const Place& place) {
  DerivedJson fix = location_fix(time_ns, "vehicle", place, -number_in(message, "depth_m").value_or(0));
  put_covariance(fix, number_in(message, "east_std_m"), number_in(message, "north_std_m"), std::nullopt);
  if (const auto heading_rad = number_in(message, "heading_rad")) fix["heading"] = *heading_rad;
  if (const auto velocity = vector_in(message, "velocity_m_s"))
    fix["velocity"] = vector((*velocity)[1], (*velocity)[0], -(*velocity)[2]);
  fix["color"] = kReckonedColour;
  fix["metadata"] = metadata({{"source", "/nav"}, {"position", text_in(message, "position")}});
  return json_text(fix);
}

int level_of(std::string_view severity) {
  enum : int { unknown = 0, info = 2, warning = 3, error = 4, fatal = 5 };
  if (severity == "info") return info;
  if (severity == "warning") return warning;
  if (severity == "error") return error;
  return severity == "alarm" ? fatal : unknown;
}

std::string log_of_event(const nlohmann::json& message, std::int64_t time_ns) {
  return json_text({{"timestamp", timestamp(time_ns)},
                    {"level", level_of(text_in(message, "severity"))},
                    {"message", event_text(message)},
                    {"name", text_in(message, "name")},
                    {"file", ""},
                    {"line", 0}});
}

/// Without a heading there is no pose. An unknown tilt counts as level.
void put_pose(Derived& derived, const nlohmann::json& message, std::int64_t time_ns,
              const std::array<double, 2>& east_north_m) {
  const auto heading_rad = number_in(message, "heading_rad");
  if (!heading_rad) return;
  const Quaternion turn = orientation_in_map(*heading_rad, number_in(message, "pitch_rad").value_or(0),
                                             number_in(message, "roll_rad").value_or(0));
  const DerivedJson rotation{{"x", turn.x}, {"y", turn.y}, {"z", turn.z}, {"w", turn.w}};
  const DerivedJson position =
      vector(east_north_m[0], east_north_m[1], -number_in(message, "depth_m").value_or(0));
  derived.pose = json_text({{"timestamp", timestamp(time_ns)},
                            {"frame_id", "map"},
                            {"pose", {{"position", position}, {"orientation", rotation}}}});
  derived.transform = json_text({{"timestamp", timestamp(time_ns)},
                                 {"parent_frame_id", "map"},
                                 {"child_frame_id", "vehicle"},
                                 {"translation", position},
                                 {"rotation", rotation}});
}

/// Bound of what is kept: a broken peer may name new topics without end.
constexpr std::size_t kMaxChannels = 1024;

bool has_source(const std::vector<std::string>& sources, const std::vector<Topic>& topics) {
  return std::ranges::any_of(
      topics, [&](const Topic& topic) { return std::ranges::find(sources, topic.name) != sources.end(); });
}

struct DerivedChannel {
  const char* topic;
  std::string schema_name;
  std::vector<std::string> sources;
  std::optional<std::string> Derived::*member;
  std::string schema{};
};

const std::vector<DerivedChannel>& derived_channels() {
  static const std::vector<DerivedChannel> channels = [] {
    std::vector<DerivedChannel> made{
        {"/foxglove/location", "foxglove.LocationFix", {"/gps", "/nav"}, &Derived::location},
        {"/foxglove/pose", "foxglove.PoseInFrame", {"/nav"}, &Derived::pose},
        {"/foxglove/tf", "foxglove.FrameTransform", {"/nav"}, &Derived::transform},
        {"/foxglove/log", "foxglove.Log", {"/event"}, &Derived::log},
    };
    const auto schemas = nlohmann::ordered_json::parse(schemas_json());
    for (DerivedChannel& channel : made) {
      const auto is_its = [&](const auto& schema) { return schema["title"] == channel.schema_name; };
      channel.schema = std::ranges::find_if(schemas, is_its)->dump();
    }
    return made;
  }();
  return channels;
}

}  // namespace

Quaternion orientation_in_map(double heading_rad, double pitch_rad, double roll_rad) {
  const double yaw = (std::numbers::pi / 2 - heading_rad) / 2, pitch = -pitch_rad / 2, roll = roll_rad / 2;
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  const double cr = std::cos(roll), sr = std::sin(roll);
  return {sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
          cr * cp * cy + sr * sp * sy};
}

Derived Deriver::derive(const Record& record, std::int64_t time_ns) {
  const bool is_fix = record.topic == "/gps", is_event = record.topic == "/event";
  if (!is_fix && !is_event && record.topic != "/nav") return {};
  const auto message = nlohmann::json::parse(record.message, nullptr, false);
  if (!message.is_object()) return {};
  Derived derived;
  if (is_fix) {
    derived.location = location_of_fix(message, time_ns);
  } else if (is_event) {
    derived.log = log_of_event(message, time_ns);
  } else {
    const auto place = place_in(message);
    if (place && text_in(message, "position") == "reckoned")
      derived.location = location_of_reckoning(message, time_ns, *place);
    put_pose(derived, message, time_ns,
             place ? position_in_map(place->latitude_deg, place->longitude_deg) : std::array<double, 2>{});
  }
  return derived;
}

std::array<double, 2> Deriver::position_in_map(double latitude_deg, double longitude_deg) {
  const double latitude_rad = latitude_deg * base::kRadiansPerDegree;
  const double longitude_rad = longitude_deg * base::kRadiansPerDegree;
  if (origin_) {
    const auto [north_m, east_m] = origin_->position_m(latitude_rad, longitude_rad);
    if (std::hypot(north_m, east_m) < kMaxDistance_m) return {east_m, north_m};
  }
  origin_.emplace(latitude_rad, longitude_rad);
  return {};
}

std::vector<const Channel*> Channels::available(const std::vector<Topic>& topics) {
  std::vector<const Channel*> found;
  const auto add = [&found](const Channel* channel) {
    if (channel != nullptr) found.push_back(channel);
  };
  for (const Topic& topic : topics)
    add(known({.sources = {topic.name}}, topic.name, topic.schema_name, topic.schema));
  for (const DerivedChannel& derived : derived_channels()) {
    if (has_source(derived.sources, topics))
      add(known({.sources = derived.sources, .member = derived.member}, derived.topic, derived.schema_name,
                derived.schema));
  }
  for (const Channel* channel : ros_) {
    if (has_source(channel->sources, topics)) add(channel);
  }
  return found;
}

Channel* Channels::known(Channel channel, const std::string& topic, const std::string& schema_name,
                         const std::string& schema) {
  const std::tuple key{topic, schema_name, schema};
  const auto found = channels_.find(key);
  if (found != channels_.end()) return &found->second;
  if (channels_.size() >= kMaxChannels) return nullptr;
  channel.id = static_cast<std::uint32_t>(channels_.size() + 1);
  channel.announcement = foxglove::channel(channel.id, topic, schema_name, schema, !channel.ros_topic.empty());
  return &channels_.emplace(key, std::move(channel)).first->second;
}

std::size_t Channels::learn_ros(const Record& record, std::uint64_t serial) {
  turn_to(record, serial);
  const std::string source(record.topic);
  for (const record::RosMessage& made : ros_made_) {
    const auto found = std::ranges::find(ros_, made.topic, &Channel::ros_topic);
    if (found == ros_.end()) {
      Channel channel{.sources = {source}, .ros_topic = made.topic};
      if (auto* const added = known(std::move(channel), made.topic, made.type->name, made.type->definition))
        ros_.push_back(added);
    } else if (auto& sources = (*found)->sources; std::ranges::find(sources, source) == sources.end()) {
      sources.push_back(source);  // the temperature of a port may come with more than one of its samples
    }
  }
  return ros_.size();
}

std::optional<std::string_view> Channels::message(const Channel& channel, const Record& record,
                                                  std::int64_t time_ns, std::uint64_t serial) {
  turn_to(record, serial);
  if (!channel.ros_topic.empty()) {
    const auto found = std::ranges::find(ros_made_, channel.ros_topic, &record::RosMessage::topic);
    return found != ros_made_.end() ? std::optional<std::string_view>(found->cdr) : std::nullopt;
  }
  if (channel.member == nullptr) return record.message;
  if (!derived_) derived_ = deriver_.derive(record, time_ns);
  const auto& made = *derived_.*channel.member;
  return made ? std::optional<std::string_view>(*made) : std::nullopt;
}

void Channels::turn_to(const Record& record, std::uint64_t serial) {
  std::string from = std::string(record.topic) + ' ' + std::string(record.device);
  if (serial == made_serial_ && from == made_from_) return;
  made_serial_ = serial;
  made_from_ = std::move(from);
  derived_.reset();
  ros_made_.clear();
  if (record.utc_ns) ros_made_ = samples_.made_of(record.topic, record.message, *record.utc_ns);
}

}  // namespace navcal::web::foxglove

// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/signalk_model.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "web/outlets/json_members.h"
#include "web/outlets/members.h"

namespace navcal::web {
namespace {

using nlohmann::json;

constexpr std::string_view kBatteries = "electrical.batteries.";

/// A number, or null.
json signalk_number(std::optional<double> value) { return value ? json(*value) : json(nullptr); }

/// All members, or null when one of them is not known.
json signalk_object(std::initializer_list<std::pair<const char*, std::optional<double>>> members) {
  json object = json::object();
  for (const auto& [key, value] : members) {
    if (!value) return nullptr;
    object[key] = *value;
  }
  return object;
}

/// A key of Signal K has letters and digits only.
std::string signalk_instance(std::string_view device) {
  std::string instance;
  std::copy_if(device.begin(), device.end(), std::back_inserter(instance),
               [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
  return instance.empty() ? "0" : instance;
}

/// Appends the paths that are numbers of the message.
void append_numbers(std::vector<SignalKValue>& values, const std::string& head, const Members& members,
                    const json& message) {
  for (const Member& member : members)
    if (member.key != "-") values.push_back({head + member.name, signalk_number(member.of(message))});
}

std::vector<SignalKValue> signalk_rates(const json& imu) {
  auto rate = number_in(imu, "yaw_rate_calibrated_rad_s");
  if (const auto rates = vector_in(imu, "rate_rad_s"); rates && !rate) rate = (*rates)[2];
  const auto std_rad_s = rate ? number_in(imu, "rate_std_rad_s") : std::nullopt;
  return {{"navigation.rateOfTurn", signalk_number(rate)},
          {"navigation.rateOfTurn.standardError", signalk_number(std_rad_s)}};
}

}  // namespace

json signalk_meta(std::string_view path) {
  const auto meta_in = [](const Members& members, std::string_view name) -> json {
    const auto found = std::ranges::find(members, name, &Member::name);
    if (found == members.end()) return nullptr;
    json meta{{"description", found->help}};
    if (found->unit != "-") meta["units"] = found->unit;
    return meta;
  };
  if (!path.starts_with(kBatteries)) return meta_in(members_of("signalk"), path);
  const auto instance_end = path.find('.', kBatteries.size());
  return instance_end == std::string_view::npos
             ? json(nullptr)
             : meta_in(members_of("signalk_battery"), path.substr(instance_end + 1));
}

SignalKUpdate SignalKModel::take(const Record& record) {
  SignalKUpdate update{std::string(record.device), record.utc_ns, {}};
  if (std::find(std::begin(kTopics), std::end(kTopics), record.topic) == std::end(kTopics)) return update;
  const auto message = json::parse(record.message, nullptr, false);
  if (!message.is_object()) return update;
  Values values;
  if (record.topic == "/health") {
    take_health(message);
    values.push_back({"navigation.magneticVariation", signalk_number(declination_rad_)});
  } else if (record.topic == "/nav") {
    values = navigation(message);
    append_numbers(values, "", members_of("signalk"), message);
  } else if (record.topic == "/compass" && serves("heading", record.device)) {
    values = compass(message);
  } else if (record.topic == "/imu" && serves("rates", record.device)) {
    values = signalk_rates(message);
  } else if (record.topic == "/battery") {
    append_numbers(values, std::string(kBatteries) + signalk_instance(record.device) + '.',
                   members_of("signalk_battery"), message);
  }
  for (SignalKValue& one : values) {
    const bool was_known = newest_.contains(one.path);
    if (one.value.is_null()) {
      if (!was_known) continue;
      newest_.erase(one.path);
    } else {
      newest_[one.path] = {update.device, update.utc_ns, one.value};
    }
    update.values.push_back(std::move(one));
  }
  return update;
}

SignalKUpdate SignalKModel::forget() {
  SignalKUpdate update;
  for (const auto& [path, kept] : newest_) update.values.push_back({path, nullptr});
  newest_.clear();
  sources_.clear();
  declination_rad_.reset();
  return update;
}

std::vector<SignalKUpdate> SignalKModel::newest() const {
  std::vector<SignalKUpdate> updates;
  for (const auto& [path, kept] : newest_) {
    const auto same = std::find_if(updates.begin(), updates.end(), [&kept = kept](const SignalKUpdate& update) {
      return update.device == kept.device && update.utc_ns == kept.utc_ns;
    });
    SignalKUpdate& update =
        same != updates.end() ? *same : updates.emplace_back(SignalKUpdate{kept.device, kept.utc_ns, {}});
    update.values.push_back({path, kept.value});
  }
  return updates;
}

void SignalKModel::take_health(const json& health) {
  const json& field = member_of(health, "earth_field");
  const bool is_known = text_in(field, "declination_source") != "none";
  declination_rad_ =
      is_known ? scaled(number_in(field, "declination"), base::kRadiansPerDegree) : std::optional<double>();
  const json& sources = member_of(health, "sources");
  if (!sources.is_object()) return;
  sources_.clear();
  for (const auto& [role, device] : sources.items()) {
    if (device.is_string()) sources_[role] = device.get<std::string>();
  }
}

/// Every device serves a role of which nothing is said.
bool SignalKModel::serves(std::string_view role, std::string_view device) const {
  const auto found = sources_.find(role);
  return found == sources_.end() || found->second == device;
}

SignalKModel::Values SignalKModel::navigation(const json& nav) const {
  // Without a declination the estimator's heading is magnetic.
  const auto true_heading = declination_rad_ ? number_in(nav, "heading_rad") : std::nullopt;
  const auto heading_std = true_heading ? number_in(nav, "heading_std_rad") : std::nullopt;
  std::optional<double> north, east;
  if (const auto velocity = vector_in(nav, "velocity_m_s")) north = (*velocity)[0], east = (*velocity)[1];
  const auto set_north = number_in(nav, "set_north_m_s"), set_east = number_in(nav, "set_east_m_s");
  const auto speed = [](auto n, auto e) { return n && e ? std::optional(std::hypot(*n, *e)) : std::nullopt; };
  const auto course = [](auto n, auto e) {
    return n && e ? std::optional(base::positive_angle(std::atan2(*e, *n))) : std::nullopt;
  };
  const json position =
      signalk_object({{"latitude", number_in(nav, "lat")}, {"longitude", number_in(nav, "lon")}});
  return {{"navigation.position", position},
          {"navigation.position.standardError", position.is_null()
                                                    ? position
                                                    : signalk_object({{"north", number_in(nav, "north_std_m")},
                                                                      {"east", number_in(nav, "east_std_m")}})},
          {"navigation.headingTrue", signalk_number(true_heading)},
          {"navigation.headingTrue.standardError", signalk_number(heading_std)},
          {"navigation.attitude", signalk_object({{"roll", number_in(nav, "roll_rad")},
                                                  {"pitch", number_in(nav, "pitch_rad")},
                                                  {"yaw", number_in(nav, "heading_rad")}})},
          {"navigation.speedOverGround", signalk_number(speed(north, east))},
          {"navigation.courseOverGroundTrue", signalk_number(course(north, east))},
          {"environment.current",
           signalk_object({{"drift", speed(set_north, set_east)}, {"setTrue", course(set_north, set_east)}})}};
}

SignalKModel::Values SignalKModel::compass(const json& compass) const {
  const auto said = number_in(compass, "heading_rad"), calibrated = number_in(compass, "heading_calibrated_rad");
  // A device that says true headings has its own declination in them: it says nothing magnetic.
  if (!said || flag_in(compass, "heading_is_true") != 0.0) return {};
  const double magnetic = base::positive_angle(calibrated.value_or(*said));
  const json deviation = calibrated ? json(base::wrapped(*calibrated - *said)) : json();
  return {{"navigation.headingMagnetic", magnetic},
          {"navigation.headingMagnetic.standardError", signalk_number(number_in(compass, "heading_std_rad"))},
          {"navigation.headingCompass", base::positive_angle(*said)},
          {"navigation.magneticDeviation", deviation}};
}

}  // namespace navcal::web

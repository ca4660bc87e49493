// SPDX-License-Identifier: Apache-2.0
#include "web/foxglove/schemas.h"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>

namespace navcal::web::foxglove {
namespace {

using SchemaJson = nlohmann::ordered_json;

SchemaJson numbers(const char* title, std::initializer_list<const char*> names) {
  SchemaJson json{{"type", "object"}, {"title", title}};
  for (const char* name : names) json["properties"][name]["type"] = "number";
  return json;
}

SchemaJson number(const char* description) { return {{"type", "number"}, {"description", description}}; }
SchemaJson text(const char* description) { return {{"type", "string"}, {"description", description}}; }
SchemaJson integer(const char* description) { return {{"type", "integer"}, {"description", description}}; }

/// Programs know a time by this title and these two members.
SchemaJson time_schema() {
  SchemaJson json{{"type", "object"}, {"title", "time"}};
  json["properties"]["sec"] = {{"type", "integer"}, {"minimum", 0}};
  json["properties"]["nsec"] = {{"type", "integer"}, {"minimum", 0}, {"maximum", 999999999}};
  return json;
}

SchemaJson vector_schema() { return numbers("foxglove.Vector3", {"x", "y", "z"}); }
SchemaJson quaternion_schema() { return numbers("foxglove.Quaternion", {"x", "y", "z", "w"}); }

SchemaJson list_of(SchemaJson items) { return {{"type", "array"}, {"items", std::move(items)}}; }

std::string schema(const char* title, SchemaJson properties) {
  SchemaJson json{{"title", title}, {"type", "object"}};
  json["properties"] = std::move(properties);
  return json.dump();
}

}  // namespace

std::string location_fix_schema() {
  SchemaJson pair{{"type", "object"}, {"title", "foxglove.KeyValuePair"}};
  pair["properties"] = {{"key", text("name")}, {"value", text("value")}};
  SchemaJson properties;
  properties["timestamp"] = time_schema();
  properties["frame_id"] = text("port of the receiver, or vehicle for what is reckoned");
  properties["latitude"] = number("deg");
  properties["longitude"] = number("deg");
  properties["altitude"] = number("m, of a fix above the ellipsoid, of what is reckoned above the surface");
  properties["position_covariance"] = list_of(number("m^2: east, north, up, row by row"));
  properties["position_covariance_type"] = integer("0 unknown, 1 approximated, 2 diagonal known, 3 known");
  properties["heading"] = number("rad, clockwise from true north");
  properties["velocity"] = vector_schema();
  properties["color"] = numbers("foxglove.Color", {"r", "g", "b", "a"});
  properties["metadata"] = list_of(std::move(pair));
  return schema("foxglove.LocationFix", std::move(properties));
}

std::string pose_in_frame_schema() {
  SchemaJson pose{{"type", "object"}, {"title", "foxglove.Pose"}};
  pose["properties"]["position"] = vector_schema();
  pose["properties"]["orientation"] = quaternion_schema();
  SchemaJson properties;
  properties["timestamp"] = time_schema();
  properties["frame_id"] = text("map: east, north, up");
  properties["pose"] = std::move(pose);
  return schema("foxglove.PoseInFrame", std::move(properties));
}

std::string frame_transform_schema() {
  SchemaJson properties;
  properties["timestamp"] = time_schema();
  properties["parent_frame_id"] = text("map: east, north, up");
  properties["child_frame_id"] = text("vehicle: forward, port, up");
  properties["translation"] = vector_schema();
  properties["rotation"] = quaternion_schema();
  return schema("foxglove.FrameTransform", std::move(properties));
}

std::string log_schema() {
  SchemaJson properties;
  properties["timestamp"] = time_schema();
  properties["level"] = integer("2 info, 3 warning, 4 error, 5 alarm");
  properties["message"] = text("port and message of the event");
  properties["name"] = text("name of the event");
  properties["file"] = text("empty");
  properties["line"] = integer("0");
  return schema("foxglove.Log", std::move(properties));
}

}  // namespace navcal::web::foxglove

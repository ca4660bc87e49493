// SPDX-License-Identifier: Apache-2.0
#include "record/json/base64.h"
#include "record/json/calibration_json.h"
#include "record/json/correction_json.h"
#include "record/json/flat_json.h"
#include "record/json/json_object.h"
#include "record/json/mapping_json.h"

namespace navcal::record {
namespace {

using Cause = pipeline::CalibrationChange::Cause;

constexpr std::string_view kHead = "{\"class\":\"CALIBRATION\"";

std::optional<Cause> cause_named(std::string_view name) {
  for (const Cause cause :
       {Cause::begin, Cause::automatic, Cause::accept, Cause::force, Cause::roll_back, Cause::start}) {
    if (pipeline::name_of(cause) == name) return cause;
  }
  return std::nullopt;
}

std::string in_force_json(const calib::Correction& correction) {
  auto json = nlohmann::ordered_json::object();
  for (const auto calibrator : calib::calibrators()) {
    if (calib::has(correction, calibrator))
      json[std::string(calib::name_of(calibrator))] = correction_json(correction, calibrator);
  }
  return json.dump();
}

}  // namespace

void append_json(std::string& out, const pipeline::UtcMapping& mapping,
                 const pipeline::CalibrationChange& change) {
  JsonObject json(out, "CALIBRATION");
  json.seconds("time", mapping.to_utc(change.time_ns));
  json.seconds("monotonic", change.time_ns);
  json.text("cause", pipeline::name_of(change.cause));
  json.text("calibrator", change.calibrator ? calib::name_of(*change.calibrator) : "");
  json.text("name", change.name.text());
  json.raw("in_force", in_force_json(change.in_force));
  if (change.cause == Cause::begin) json.text("state", base64(change.state));
}

bool is_calibration_change(std::string_view json) { return json.starts_with(kHead); }

std::optional<pipeline::CalibrationChange> calibration_from_json(std::string_view json) {
  if (!is_calibration_change(json)) return std::nullopt;
  const auto members = FlatJson::parse(json);
  const auto cause = members ? cause_named(members->get("cause")) : std::nullopt;
  const auto time_ns = members ? nanoseconds(members->get("monotonic")) : std::nullopt;
  if (!cause || !time_ns) return std::nullopt;
  pipeline::CalibrationChange change;
  change.time_ns = *time_ns;
  change.cause = *cause;
  change.calibrator = calib::calibrator_named(members->get("calibrator"));
  if (*cause == Cause::begin) {
    auto state = from_base64(members->get("state"));
    if (!state) return std::nullopt;
    change.state = std::move(*state);
  } else if (!change.calibrator) {
    return std::nullopt;
  }
  return change;
}

}  // namespace navcal::record

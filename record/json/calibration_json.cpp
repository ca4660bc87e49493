// SPDX-License-Identifier: Apache-2.0
#include "record/json/calibration_json.h"

#include <fmt/format.h>

#include <iterator>

#include "base/angles.h"
#include "base/enum_name.h"
#include "record/json/base64.h"
#include "record/json/correction_json.h"
#include "record/json/flat_json.h"
#include "record/json/json_object.h"
#include "record/json/mapping_json.h"
#include "record/json/put_members.h"

namespace navcal::record {

namespace {

using Json = nlohmann::ordered_json;

/// libgps reads lines of up to 10 kB.
constexpr std::size_t kLongestLine = 9000;

Json calibrator_json(const calib::CalibratorReport& report, const calib::Correction& in_force) {
  const auto& judgement = report.judgement;
  Json json;
  json["calibrator"] = calib::name_of(report.calibrator);
  json["verdict"] = calib::name_of(report.verdict);
  NAVCAL_PUT_MEMBERS(json, judgement, accepted, reason, manoeuvre, coverage, condition, samples);
  json["judgement"] = calib::name_of(report.outcome);
  const bool judged = judgement.held_out_quantity == calib::HeldOutQuantity::heading;
  const bool by_field = judgement.held_out_quantity == calib::HeldOutQuantity::field;
  json["held_out_before_deg"] =
      judged ? number_json(judgement.held_out_before * base::kDegreesPerRadian) : Json(nullptr);
  json["held_out_after_deg"] =
      judged ? number_json(judgement.held_out_after * base::kDegreesPerRadian) : Json(nullptr);
  json["held_out_before_percent"] = by_field ? number_json(judgement.held_out_before * 100) : Json(nullptr);
  json["held_out_after_percent"] = by_field ? number_json(judgement.held_out_after * 100) : Json(nullptr);
  json["estimate"] = values_json(report.estimate, &calib::Quantity::value);
  json["std"] = values_json(report.estimate, &calib::Quantity::std);
  json["in_force"] = correction_json(in_force, report.calibrator);
  if (!report.step_std_uT.isZero(0))
    json["in_force_step_std_uT"] = {report.step_std_uT.x(), report.step_std_uT.y(), report.step_std_uT.z()};
  NAVCAL_PUT_MEMBERS(json, report, held, steps_back);
  return json;
}

Json heading_in_force_json(const calib::HeadingCheck& heading) {
  const auto degrees = [&](double rad) {
    return heading.blocks > 0 ? number_json(rad * base::kDegreesPerRadian) : Json(nullptr);
  };
  Json json;
  json["blocks"] = heading.blocks;
  json["before_rms_deg"] = degrees(heading.before_rad);
  json["after_rms_deg"] = degrees(heading.after_rad);
  json["in_force_rms_deg"] = degrees(heading.in_force_rad);
  return json;
}

/// Members that all lines of a report have.
std::string beginning(const calib::Report& report, std::optional<std::int64_t> utc_ns) {
  std::string out;
  {
    JsonObject json(out, "CALIB");
    if (utc_ns) json.seconds("time", *utc_ns);
    json.text("name", report.name.text());
  }
  out.pop_back();
  return out;
}

}  // namespace

std::vector<std::string> calib_lines(const calib::Report& report, std::optional<std::int64_t> utc_ns,
                                     std::string_view compasses) {
  const std::string common = beginning(report, utc_ns);
  Json whole;
  whole["heading"] = heading_in_force_json(report.heading);
  whole["rose"] = report.rose;
  if (!report.steps.empty()) whole["field_step"] = steps_json({report.steps.back()}).front();
  whole["left_out"] = gate_json(report.gate);
  std::string rest = whole.dump();
  if (!compasses.empty()) {
    rest.pop_back();
    rest.append(",").append(compasses).append("}");
  }
  rest.front() = ',';  // its members go on where those of the beginning end

  std::vector<std::string> lists(1);
  for (const auto& calibrator : report.calibrators) {
    const std::string one = calibrator_json(calibrator, report.in_force).dump();
    if (!lists.back().empty() && common.size() + lists.back().size() + one.size() + rest.size() > kLongestLine)
      lists.emplace_back();
    if (!lists.back().empty()) lists.back() += ',';
    lists.back() += one;
  }
  std::vector<std::string> lines;
  for (const std::string& list : lists) {
    std::string line = common;
    if (lists.size() > 1) {
      fmt::format_to(std::back_inserter(line), ",\"part\":{},\"parts\":{}", lines.size() + 1, lists.size());
    }
    fmt::format_to(std::back_inserter(line), ",\"calibrators\":[{}]{}", list, rest);
    lines.push_back(std::move(line));
  }
  return lines;
}

namespace {

using Cause = pipeline::CalibrationChange::Cause;

constexpr std::string_view kHead = "{\"class\":\"CALIBRATION\"";

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
  const auto cause =
      members ? base::enum_named<Cause::start>(members->get("cause"), [](auto one) { return name_of(one); })
              : std::nullopt;
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

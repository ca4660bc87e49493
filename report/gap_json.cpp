// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>

#include "base/angles.h"
#include "record/json/calibration_json.h"
#include "report/gap_report.h"
#include "report/gap_words.h"
#include "report/where_json.h"

namespace navcal::gap {
namespace {

/// Name and, of a layout, the part that it belongs to.
template <class Named>
nlohmann::ordered_json named(const Named& effect) {
  nlohmann::ordered_json json{{"name", effect.name}};
  if (!effect.of.empty()) json["of"] = effect.of;
  return json;
}

nlohmann::ordered_json before_and_after(const std::optional<std::array<double, 2>>& values) {
  if (!values) return nullptr;
  return {{"before", values->front()}, {"after", values->back()}};
}

}  // namespace

NAVCAL_JSON_MEMBERS(Confusion, name, tie_breaker, separation_nats)

static void to_json(nlohmann::ordered_json& json, const EffectFinding& effect) {
  json = named(effect);
  json["probability"] = effect.probability;
  auto& parameters = json["parameters"] = nlohmann::ordered_json::object();
  for (const auto& parameter : effect.parameters) parameters[parameter.name] = parameter.value;
  auto& errors = json["std_errors"] = nlohmann::ordered_json::object();
  for (const auto& parameter : effect.parameters) errors[parameter.name] = parameter.std_error;
  json["confused_with"] = effect.confused_with;
}

NAVCAL_JSON_MEMBERS(Alternative, effects, probability, closed)
NAVCAL_JSON_MEMBERS(Closure, before, after, floor, closed, closed_ci)

static void to_json(nlohmann::ordered_json& json, const ChannelClosure& channel) {
  json["channel"] = channel.channel;
  json.update(nlohmann::ordered_json(channel.closure));
  json["unit"] = channel.unit;
}

static void to_json(nlohmann::ordered_json& json, const Gap& gap) {
  json = gap.pooled;
  json["unit"] = "noise power";
  NAVCAL_PUT_MEMBERS(json, gap, channels, held_out);
  json["heading_error_rad"] = before_and_after(gap.heading_error_rad);
  json["dead_reckoning_m_per_100m"] = before_and_after(gap.dead_reckoning_m_per_100m);
}

NAVCAL_JSON_MEMBERS(ChangePoint, channel, time_s, before, after, unit)
NAVCAL_JSON_MEMBERS(BankFacts, missions, seed, from_cache, seconds)
NAVCAL_JSON_MEMBERS(CommandCheck, delay_s, correlation, saturated, unrecorded)
NAVCAL_JSON_MEMBERS(LeastVisible, name, of, parameter, value, typical)

static void to_json(nlohmann::ordered_json& json, const Interruption& each) {
  json = {{"name", each.what}, {"from_s", each.from_s}, {"until_s", each.until_s}};
}

NAVCAL_JSON_MEMBERS(InstrumentFacts, missing, interrupted, not_judged)

static void to_json(nlohmann::ordered_json& json, const EarthField& field) {
  json = {{"source", name_of(field.source)},
          {"north_east_down_uT", field.north_east_down_uT},
          {"place", nullptr},
          {"date", nullptr}};
  if (field.place) {
    json["place"] = {{"latitude_deg", field.place->latitude_rad * base::kDegreesPerRadian},
                     {"longitude_deg", field.place->longitude_rad * base::kDegreesPerRadian},
                     {"height_m", field.place->height_m}};
  }
  if (field.utc_ns) json["date"] = field.date();
}

NAVCAL_JSON_MEMBERS(RecordingFinding::Alone, effects, probability)

static void to_json(nlohmann::ordered_json& json, const RecordingFinding& finding) {
  NAVCAL_PUT_MEMBERS(json, finding, recording, effects, alone);
  for (auto& effect : json["effects"]) {
    effect.erase("probability");
    effect.erase("confused_with");
  }
}

static void to_json(nlohmann::ordered_json& json, const ErrorFinding& error) {
  NAVCAL_PUT_MEMBERS(json, error, component, channel, follows, families, rms, std_error, unit);
  if (error.channel.empty()) json["channel"] = nullptr;
}

static void to_json(nlohmann::ordered_json& json, const SourceFinding& source) {
  json["source"] = source.name;
  NAVCAL_PUT_MEMBERS(json, source, gain_nats, errors);
}

static void to_json(nlohmann::ordered_json& json, const Proposal& proposal) {
  json = proposal.source;
  json.erase("gain_nats");
  NAVCAL_PUT_MEMBERS(json, proposal, held_out, held_out_gain_nats);
  NAVCAL_PUT_MEMBERS(json["power"], proposal.power, before, after, floor);
  json["warning"] = report::kDescriptionNotCause;
}

static void to_json(nlohmann::ordered_json& json, const EffectDifference& difference) {
  json = named(difference);
  NAVCAL_PUT_MEMBERS(json, difference, p_value, differs);
}

}  // namespace navcal::gap

namespace navcal::report {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// The smallest p-value of the residual map; null without a map.
OrderedJson least_p_value(const gap::Diagnosis& diagnosis) {
  if (diagnosis.map.empty()) return {};
  return std::ranges::min(diagnosis.map, {}, &gap::WhereEntry::p_value).p_value;
}

}  // namespace

std::string gap_json(const gap::Diagnosis& diagnosis) {
  const auto& bias = diagnosis.gyro_bias_rad_s;
  OrderedJson json{{"verdict", gap::name_of(diagnosis.verdict)}};
  NAVCAL_PUT_MEMBERS(json, diagnosis, sentence, where);
  json["least_p_value"] = least_p_value(diagnosis);
  NAVCAL_PUT_MEMBERS(json, diagnosis, sources, proposal, effects, gap, unexplained, candidates, next, remarks);
  json["gyro_bias"] = {{"ax_rad_s", bias[0]}, {"az_rad_s", bias[1]}, {"by_rad_s", bias[2]}, {"bz_rad_s", bias[3]}};
  NAVCAL_PUT_MEMBERS(json, diagnosis, instruments, commands, least_ratio, changes, field, bank, duration_s,
                     seconds);
  if (diagnosis.verdict == gap::Verdict::unknown) {
    json["kind"] = gap::name_of(diagnosis.kind);
    json["alternatives"] = diagnosis.alternatives;
  }
  if (!diagnosis.least_visible.empty()) json["least_visible"] = diagnosis.least_visible;
  if (!diagnosis.recordings.empty()) NAVCAL_PUT_MEMBERS(json, diagnosis, recordings, differences);
  if (diagnosis.instruments_alone) {
    std::string alone;
    record::append_calibrate_json(alone, *diagnosis.instruments_alone);
    json["instruments_alone"] = OrderedJson::parse(alone);
  }
  // A file name in a remark may be invalid UTF-8.
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace navcal::report

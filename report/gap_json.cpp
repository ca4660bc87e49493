// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "record/json/calibration_json.h"
#include "report/gap_report.h"
#include "report/gap_words.h"
#include "report/where_json.h"

namespace navcal::report {
namespace {

using OrderedJson = nlohmann::ordered_json;

template <class Element, class Convert>
OrderedJson list_of(const std::vector<Element>& elements, Convert convert) {
  OrderedJson list = OrderedJson::array();
  for (const Element& element : elements) list.push_back(convert(element));
  return list;
}

OrderedJson json_of(const gap::Confusion& confusion) {
  return {{"name", confusion.name},
          {"tie_breaker", confusion.tie_breaker},
          {"separation_nats", confusion.separation_nats}};
}

/// Name and, of a layout, the part that it belongs to.
template <class Named>
OrderedJson named(const Named& effect) {
  OrderedJson json{{"name", effect.name}};
  if (!effect.of.empty()) json["of"] = effect.of;
  return json;
}

OrderedJson sizes_of(const gap::EffectFinding& effect) {
  OrderedJson parameters = OrderedJson::object(), errors = OrderedJson::object();
  for (const auto& parameter : effect.parameters) {
    parameters[parameter.name] = parameter.value;
    errors[parameter.name] = parameter.std_error;
  }
  return {{"parameters", std::move(parameters)}, {"std_errors", std::move(errors)}};
}

OrderedJson json_of(const gap::EffectFinding& effect) {
  OrderedJson json = named(effect);
  json["probability"] = effect.probability;
  json.update(sizes_of(effect));
  json["confused_with"] = list_of(effect.confused_with, [](const auto& other) { return json_of(other); });
  return json;
}

OrderedJson json_of(const gap::Alternative& alternative) {
  return {{"effects", list_of(alternative.effects, [](const auto& effect) { return json_of(effect); })},
          {"probability", alternative.probability},
          {"closed", alternative.closed ? OrderedJson(*alternative.closed) : OrderedJson()}};
}

OrderedJson json_of(const gap::Closure& closure, const std::string& unit) {
  OrderedJson closed, interval;
  if (closure.closed) closed = *closure.closed;
  if (closure.closed_ci) interval = *closure.closed_ci;
  return {{"before", closure.before},    {"after", closure.after},           {"floor", closure.floor},
          {"closed", std::move(closed)}, {"closed_ci", std::move(interval)}, {"unit", unit}};
}

OrderedJson before_and_after(const std::optional<std::array<double, 2>>& values) {
  if (!values) return nullptr;
  return {{"before", values->front()}, {"after", values->back()}};
}

OrderedJson json_of(const gap::Gap& gap) {
  OrderedJson json = json_of(gap.pooled, "noise power");
  json["channels"] = list_of(gap.channels, [](const gap::ChannelClosure& channel) {
    OrderedJson one = OrderedJson::object();
    one["channel"] = channel.channel;
    one.update(json_of(channel.closure, channel.unit));
    return one;
  });
  json["held_out"] = gap.held_out;
  json["heading_error_rad"] = before_and_after(gap.heading_error_rad);
  json["dead_reckoning_m_per_100m"] = before_and_after(gap.dead_reckoning_m_per_100m);
  return json;
}

OrderedJson json_of(const gap::ChangePoint& change) {
  return {{"channel", change.channel},
          {"time_s", change.time_s},
          {"before", change.before},
          {"after", change.after},
          {"unit", change.unit}};
}

OrderedJson json_of(const gap::BankFacts& bank) {
  return {{"missions", bank.missions},
          {"seed", bank.seed},
          {"from_cache", bank.from_cache},
          {"seconds", bank.seconds}};
}

OrderedJson json_of(const gap::InstrumentFacts& instruments) {
  return {{"missing", instruments.missing},
          {"interrupted",
           list_of(instruments.interrupted,
                   [](const gap::Interruption& each) {
                     return OrderedJson{{"name", each.what}, {"from_s", each.from_s}, {"until_s", each.until_s}};
                   })},
          {"not_judged", instruments.not_judged}};
}

OrderedJson json_of(const gap::CommandCheck& commands) {
  OrderedJson delay, correlation;
  if (commands.delay_s) delay = *commands.delay_s;
  if (commands.correlation) correlation = *commands.correlation;
  return {{"delay_s", std::move(delay)},
          {"correlation", std::move(correlation)},
          {"saturated", commands.saturated},
          {"unrecorded", commands.unrecorded}};
}

OrderedJson json_of(const gap::EarthField& field) {
  OrderedJson place, date;
  if (field.place) {
    place = {{"latitude_deg", field.place->latitude_rad * base::kDegreesPerRadian},
             {"longitude_deg", field.place->longitude_rad * base::kDegreesPerRadian},
             {"height_m", field.place->height_m}};
  }
  if (field.utc_ns) date = field.date();
  return {{"source", gap::name_of(field.source)},
          {"north_east_down_uT", field.north_east_down_uT},
          {"place", std::move(place)},
          {"date", std::move(date)}};
}

OrderedJson json_of(const gap::RecordingFinding& finding) {
  OrderedJson json{{"recording", finding.recording}};
  json["effects"] = list_of(finding.effects, [](const gap::EffectFinding& effect) {
    OrderedJson one = named(effect);
    one.update(sizes_of(effect));
    return one;
  });
  json["alone"] =
      finding.alone ? OrderedJson{{"effects", finding.alone->effects}, {"probability", finding.alone->probability}}
                    : OrderedJson();
  return json;
}

/// The smallest p-value of the residual map; null without a map.
OrderedJson least_p_value(const gap::Diagnosis& diagnosis) {
  if (diagnosis.map.empty()) return {};
  return std::min_element(diagnosis.map.begin(), diagnosis.map.end(),
                          [](const auto& a, const auto& b) { return a.p_value < b.p_value; })
      ->p_value;
}

OrderedJson json_of(const gap::ErrorFinding& error) {
  return {{"component", error.component},
          {"channel", error.channel.empty() ? OrderedJson() : OrderedJson(error.channel)},
          {"follows", error.follows},
          {"families", error.families},
          {"rms", error.rms},
          {"std_error", error.std_error},
          {"unit", error.unit}};
}

OrderedJson json_of(const gap::SourceFinding& source) {
  return {{"source", source.name},
          {"gain_nats", source.gain_nats},
          {"errors", list_of(source.errors, [](const auto& error) { return json_of(error); })}};
}

OrderedJson json_of(const gap::Proposal& proposal) {
  OrderedJson json = json_of(proposal.source);
  json.erase("gain_nats");
  json["held_out"] = proposal.held_out;
  json["held_out_gain_nats"] = proposal.held_out_gain_nats;
  json["power"] = {
      {"before", proposal.power.before}, {"after", proposal.power.after}, {"floor", proposal.power.floor}};
  json["warning"] = kDescriptionNotCause;
  return json;
}

OrderedJson json_of(const gap::EffectDifference& difference) {
  OrderedJson json = named(difference);
  json.update({{"p_value", difference.p_value}, {"differs", difference.differs}});
  return json;
}

OrderedJson json_of(const gap::LeastVisible& least) {
  return {{"name", least.name},
          {"of", least.of},
          {"parameter", least.parameter},
          {"value", least.value ? OrderedJson(*least.value) : OrderedJson()},
          {"typical", least.typical}};
}

}  // namespace

std::string gap_json(const gap::Diagnosis& diagnosis) {
  const auto convert = [](const auto& element) { return json_of(element); };
  const auto& bias = diagnosis.gyro_bias_rad_s;
  OrderedJson json{
      {"verdict", gap::name_of(diagnosis.verdict)},
      {"sentence", diagnosis.sentence},
      {"where", list_of(diagnosis.where, where_json)},
      {"least_p_value", least_p_value(diagnosis)},
      {"sources", list_of(diagnosis.sources, convert)},
      {"proposal", diagnosis.proposal ? json_of(*diagnosis.proposal) : OrderedJson()},
      {"effects", list_of(diagnosis.effects, convert)},
      {"gap", json_of(diagnosis.gap)},
      {"unexplained", diagnosis.unexplained},
      {"candidates", list_of(diagnosis.candidates, convert)},
      {"next", diagnosis.next},
      {"remarks", diagnosis.remarks},
      {"gyro_bias", {{"ax_rad_s", bias[0]}, {"az_rad_s", bias[1]}, {"by_rad_s", bias[2]}, {"bz_rad_s", bias[3]}}},
      {"instruments", json_of(diagnosis.instruments)},
      {"commands", diagnosis.commands ? json_of(*diagnosis.commands) : OrderedJson()},
      {"least_ratio", diagnosis.least_ratio ? OrderedJson(*diagnosis.least_ratio) : OrderedJson()},
      {"changes", list_of(diagnosis.changes, convert)},
      {"field", diagnosis.field ? json_of(*diagnosis.field) : OrderedJson()},
      {"bank", json_of(diagnosis.bank)},
      {"duration_s", diagnosis.duration_s},
      {"seconds", diagnosis.seconds}};
  if (diagnosis.verdict == gap::Verdict::unknown) {
    json["kind"] = gap::name_of(diagnosis.kind);
    json["alternatives"] = list_of(diagnosis.alternatives, convert);
  }
  if (!diagnosis.least_visible.empty()) json["least_visible"] = list_of(diagnosis.least_visible, convert);
  if (!diagnosis.recordings.empty()) {
    json["recordings"] = list_of(diagnosis.recordings, convert);
    json["differences"] = list_of(diagnosis.differences, convert);
  }
  if (diagnosis.instruments_alone) {
    std::string alone;
    record::append_calibrate_json(alone, *diagnosis.instruments_alone);
    json["instruments_alone"] = OrderedJson::parse(alone);
  }
  // A file name in a remark may be invalid UTF-8.
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include "record/json/put_members.h"
#include "report/noise_report.h"

namespace navcal::analysis {

NAVCAL_JSON_MEMBERS(AllanPoint, tau_s, deviation, low, high, edf)
NAVCAL_JSON_MEMBERS(Spectrum, frequency_Hz, density)
NAVCAL_JSON_MEMBERS(SpectralLine, frequency_Hz, amplitude)
NAVCAL_JSON_MEMBERS(Interval, from_s, to_s)

}  // namespace navcal::analysis

namespace navcal::report {
namespace {

using NoiseJson = nlohmann::ordered_json;

/// NAME, NAME_error, NAME_limit and NAME_needs_s.
void put_term(NoiseJson& json, const std::string& name, const analysis::NoiseTerm& term) {
  json[name] = term.value;
  json[name + "_error"] = term.error;
  json[name + "_limit"] = term.limit;
  json[name + "_needs_s"] = term.needs_s;
}

void put_reading(NoiseJson& json, const analysis::ChannelNoise& noise) {
  const auto& reading = noise.reading;
  const bool told = reading && !reading->drifts;
  json["std"] = told ? NoiseJson(reading->std) : NoiseJson();
  json["std_error"] = told ? NoiseJson(reading->std_error) : NoiseJson();
  json["rounding_std"] = noise.rounding;
  json["unrounded_std"] = noise.unrounded;
  json["unrounded_std_error"] = noise.unrounded_error;
  json["drifts"] = reading && reading->drifts;
  json["correlated"] = reading && reading->correlated;
  json["correlation"] = reading ? NoiseJson(reading->lag1) : NoiseJson();
  json["time_constant_s"] = reading ? NoiseJson(reading->time_constant_s) : NoiseJson();
  json["effective_std"] = noise.effective;
  json["effective_std_error"] = noise.effective_error;
}

NoiseJson channel_json(const analysis::RecordedChannel& recorded) {
  const analysis::ChannelNoise& noise = recorded.noise;
  NoiseJson json{{"device", recorded.port}, {"channel", recorded.quantity}, {"unit", recorded.unit}};
  NAVCAL_PUT_MEMBERS(json, noise, readings, stretches, seconds, rate_Hz, mean, scatter, resolution, constant);
  if (noise.rate_Hz <= 0) json["rate_Hz"] = nullptr;
  if (noise.readings == 0) json["mean"] = nullptr;
  if (noise.readings <= 1) json["scatter"] = nullptr;
  put_reading(json, noise);
  put_term(json, "white_noise", noise.terms.white);
  put_term(json, "bias_instability", noise.terms.flicker);
  put_term(json, "random_walk", noise.terms.walk);
  NAVCAL_PUT_MEMBERS(json, noise, allan, spectrum, lines);
  json["remarks"] = noise_remarks(recorded);
  return json;
}

}  // namespace

std::string noise_json(const analysis::NoiseReport& report) {
  NoiseJson json{
      {"class", "NOISE"}, {"file", report.file}, {"begin", static_cast<double>(report.begin_utc_ns) * 1e-9}};
  NAVCAL_PUT_MEMBERS(json, report, duration_s, quiet, chosen);
  json["reason"] = report.quiet.empty() ? NoiseJson(rest_sentence(report)) : NoiseJson();
  json["channels"] = NoiseJson::array();
  for (const auto& recorded : report.channels) json["channels"].push_back(channel_json(recorded));
  // A file's name may be any bytes.
  return json.dump(-1, ' ', false, NoiseJson::error_handler_t::replace) + "\n";
}

}  // namespace navcal::report

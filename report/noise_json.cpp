// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/noise_report.h"
#include "report/noise_words.h"

namespace navcal::report {
namespace {

using NoiseJson = nlohmann::ordered_json;

NoiseJson noise_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? NoiseJson(*value) : NoiseJson(nullptr);
}

/// NAME, NAME_error, NAME_limit and NAME_needs_s.
void put_term(NoiseJson& json, const std::string& name, const analysis::NoiseTerm& term) {
  json[name] = noise_number(term.value);
  json[name + "_error"] = noise_number(term.error);
  json[name + "_limit"] = noise_number(term.limit);
  json[name + "_needs_s"] = noise_number(term.needs_s);
}

void put_reading(NoiseJson& json, const analysis::ChannelNoise& noise) {
  const auto& reading = noise.reading;
  const bool told = reading && !reading->drifts;
  json["std"] = told ? noise_number(reading->std) : NoiseJson(nullptr);
  json["std_error"] = told ? noise_number(reading->std_error) : NoiseJson(nullptr);
  json["rounding_std"] = noise_number(noise.rounding);
  json["unrounded_std"] = noise_number(noise.unrounded);
  json["unrounded_std_error"] = noise_number(noise.unrounded_error);
  json["drifts"] = reading && reading->drifts;
  json["correlated"] = reading && reading->correlated;
  json["correlation"] = reading ? noise_number(reading->lag1) : NoiseJson(nullptr);
  json["time_constant_s"] = reading ? noise_number(reading->time_constant_s) : NoiseJson(nullptr);
  json["effective_std"] = noise_number(noise.effective);
  json["effective_std_error"] = noise_number(noise.effective_error);
}

NoiseJson channel_json(const analysis::RecordedChannel& recorded) {
  const analysis::ChannelNoise& noise = recorded.noise;
  NoiseJson json;
  json["device"] = recorded.port;
  json["channel"] = recorded.quantity;
  json["unit"] = recorded.unit;
  json["readings"] = noise.readings;
  json["stretches"] = noise.stretches;
  json["seconds"] = noise.seconds;
  json["rate_Hz"] = noise.rate_Hz > 0 ? NoiseJson(noise.rate_Hz) : NoiseJson(nullptr);
  json["mean"] = noise.readings > 0 ? NoiseJson(noise.mean) : NoiseJson(nullptr);
  json["scatter"] = noise.readings > 1 ? NoiseJson(noise.scatter) : NoiseJson(nullptr);
  json["resolution"] = noise_number(noise.resolution);
  json["constant"] = noise.constant;
  put_reading(json, noise);
  put_term(json, "white_noise", noise.terms.white);
  put_term(json, "bias_instability", noise.terms.flicker);
  put_term(json, "random_walk", noise.terms.walk);
  json["allan"] = NoiseJson::array();
  for (const auto& point : noise.allan)
    json["allan"].push_back({{"tau_s", point.tau_s},
                             {"deviation", point.deviation},
                             {"low", point.low},
                             {"high", noise_number(point.high)},
                             {"edf", point.edf}});
  NoiseJson spectrum;
  spectrum["frequency_Hz"] = noise.spectrum.frequency_Hz;
  spectrum["density"] = noise.spectrum.density;
  json["spectrum"] = std::move(spectrum);
  json["lines"] = NoiseJson::array();
  for (const auto& line : noise.lines)
    json["lines"].push_back({{"frequency_Hz", line.frequency_Hz}, {"amplitude", line.amplitude}});
  json["remarks"] = noise_remarks(recorded);
  return json;
}

}  // namespace

std::string noise_json(const analysis::NoiseReport& report) {
  NoiseJson json;
  json["class"] = "NOISE";
  json["file"] = report.file;
  json["begin"] = static_cast<double>(report.begin_utc_ns) * 1e-9;
  json["duration_s"] = report.duration_s;
  json["quiet"] = NoiseJson::array();
  for (const auto& interval : report.quiet)
    json["quiet"].push_back({{"from_s", interval.from_s}, {"to_s", interval.to_s}});
  json["chosen"] = report.chosen;
  json["reason"] = report.quiet.empty() ? NoiseJson(rest_sentence(report)) : NoiseJson(nullptr);
  json["channels"] = NoiseJson::array();
  for (const auto& recorded : report.channels) json["channels"].push_back(channel_json(recorded));
  // A file's name may be any bytes.
  return json.dump(-1, ' ', false, NoiseJson::error_handler_t::replace) + "\n";
}

}  // namespace navcal::report

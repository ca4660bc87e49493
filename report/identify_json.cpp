// SPDX-License-Identifier: Apache-2.0
#include "record/json/put_members.h"
#include "report/identify_report.h"

namespace navcal::identify {

NAVCAL_JSON_MEMBERS(BeforeAfter, before, after)
NAVCAL_JSON_MEMBERS(ManoeuvreAdvice, manoeuvre, seconds, gain_nats, parameter, std_before, std_after)
NAVCAL_JSON_MEMBERS(ChannelFit, readings, noise_scale, correlation)
NAVCAL_JSON_MEMBERS(NuisanceFit, recording, name, unit, value, std)
NAVCAL_JSON_MEMBERS(DisturbanceFit, coloured, white, unit, share)
NAVCAL_JSON_MEMBERS(PredictionFit, quantity, unit, after_s, starts, before, after, linear)

}  // namespace navcal::identify

namespace navcal::report {

std::string identify_json(const identify::Identification& found) {
  using IdentifyJson = nlohmann::ordered_json;
  IdentifyJson parameters = IdentifyJson::object(), directions = IdentifyJson::array(),
               channels = IdentifyJson::object(), disturbances = IdentifyJson::object();
  for (const auto& one : found.parameters) {
    auto& json = parameters[one.parameter.name];
    NAVCAL_PUT_MEMBERS(json, one, value, std);
    NAVCAL_PUT_MEMBERS(json, one.parameter, unit, prior, prior_std);
    json["identified"] = one.is_identified;
  }
  for (const auto& direction : found.directions) directions.push_back(direction.words);
  for (const auto& fit : found.channels) channels[std::string(identify::describe(fit.channel).name)] = fit;
  for (const auto& of : found.disturbances) disturbances[std::string(of.axis)] = of;
  IdentifyJson json{{"parameters", std::move(parameters)}, {"directions", std::move(directions)}};
  NAVCAL_PUT_MEMBERS(json, found, held_out, fitted, predictions, manoeuvres);
  json["channels"] = std::move(channels);
  json["nuisances"] = found.nuisances;
  json["disturbances"] = std::move(disturbances);
  NAVCAL_PUT_MEMBERS(json, found, disturbance_tau_s, left_out, interval_s, model_error, seconds, iterations,
                     converged, warnings);
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace navcal::report

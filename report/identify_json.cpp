// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "report/identify_report.h"

namespace navcal::report {
namespace {

using IdentifyJson = nlohmann::ordered_json;

IdentifyJson before_after_json(const identify::BeforeAfter& rms) {
  return {{"before", rms.before}, {"after", rms.after}};
}

}  // namespace

std::string identify_json(const identify::Identification& found) {
  IdentifyJson parameters = IdentifyJson::object(), directions = IdentifyJson::array(),
               manoeuvres = IdentifyJson::array(), channels = IdentifyJson::object(),
               nuisances = IdentifyJson::array(), disturbances = IdentifyJson::object(),
               predictions = IdentifyJson::array();
  for (const auto& one : found.parameters) {
    parameters[one.parameter.name] = {{"value", one.value},
                                      {"std", one.std},
                                      {"unit", one.parameter.unit},
                                      {"prior", one.parameter.prior},
                                      {"prior_std", one.parameter.prior_std},
                                      {"identified", one.is_identified}};
  }
  for (const auto& direction : found.directions) directions.push_back(direction.words);
  for (const auto& advice : found.manoeuvres) {
    manoeuvres.push_back({{"manoeuvre", advice.manoeuvre},
                          {"seconds", advice.seconds},
                          {"gain_nats", advice.gain_nats},
                          {"parameter", advice.parameter},
                          {"std_before", advice.std_before},
                          {"std_after", advice.std_after}});
  }
  for (const auto& fit : found.channels) {
    const auto& of = identify::describe(fit.channel);
    channels[std::string(of.name)] = {
        {"readings", fit.readings}, {"noise_scale", fit.noise_scale}, {"correlation", fit.correlation}};
  }
  for (const auto& nuisance : found.nuisances) {
    nuisances.push_back({{"recording", nuisance.recording},
                         {"name", nuisance.name},
                         {"unit", nuisance.unit},
                         {"value", nuisance.value},
                         {"std", nuisance.std}});
  }
  for (const auto& of : found.disturbances) {
    disturbances[std::string(of.axis)] = {{"coloured", of.coloured},
                                          {"white", of.white},
                                          {"unit", of.unit},
                                          {"share", of.share ? IdentifyJson(*of.share) : IdentifyJson()}};
  }
  for (const auto& one : found.predictions) {
    predictions.push_back({{"quantity", one.quantity},
                           {"unit", one.unit},
                           {"after_s", one.after_s},
                           {"starts", one.starts},
                           {"before", one.before},
                           {"after", one.after},
                           {"linear", one.linear ? IdentifyJson(*one.linear) : IdentifyJson()}});
  }
  const IdentifyJson json{{"parameters", parameters},
                          {"directions", directions},
                          {"held_out", found.held_out ? before_after_json(*found.held_out) : IdentifyJson()},
                          {"fitted", before_after_json(found.fitted)},
                          {"predictions", predictions},
                          {"manoeuvres", manoeuvres},
                          {"channels", channels},
                          {"nuisances", nuisances},
                          {"disturbances", disturbances},
                          {"disturbance_tau_s", found.disturbance_tau_s},
                          {"left_out", found.left_out},
                          {"interval_s", found.interval_s},
                          {"model_error", found.model_error},
                          {"seconds", found.seconds},
                          {"iterations", found.iterations},
                          {"converged", found.converged},
                          {"warnings", found.warnings}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/causes.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>

#include "base/angles.h"
#include "diagnosis/limits.h"
#include "identify/replay/calibration.h"
#include "sim/effects/effect_table.h"
#include "sim/layout/effects/layout_effects.h"

namespace navcal::diagnosis {
namespace {

using identify::Channel;
using identify::Nuisance;
using identify::RecordedMotion;

struct InstrumentParameter {
  std::string_view name;
  Nuisance nuisance;
  double typical, per_unit;
};

/// An error of instruments that the fit estimates for each recording anyway. Typical strengths as those of the
/// simulator's effects of the same name.
struct InstrumentError {
  std::string_view name, manoeuvre;
  std::vector<InstrumentParameter> parameters;
  std::vector<Channel> needs;  ///< one of them
};

const std::vector<InstrumentError>& instrument_errors() {
  static const std::vector<InstrumentError> kAll{
      {"gyro_scale",
       "turns at several rates",
       {{"scale_ax", Nuisance::rate_scale_x, 0.03, 1},
        {"scale_by", Nuisance::rate_scale_y, 0.03, 1},
        {"scale_az", Nuisance::rate_scale_z, 0.03, 1}},
       {Channel::rate_x, Channel::rate_y, Channel::rate_z}},
      {"gyro_drift",
       "lie still for minutes",
       {{"deg_per_s2_ax", Nuisance::rate_drift_x, 0.001, base::kRadiansPerDegree},
        {"deg_per_s2_by", Nuisance::rate_drift_y, 0.001, base::kRadiansPerDegree},
        {"deg_per_s2_az", Nuisance::rate_drift_z, 0.001, base::kRadiansPerDegree}},
       {Channel::rate_x, Channel::rate_y, Channel::rate_z}},
      {"imu_latency",
       "fast turns to both sides",
       {{"tau_s", Nuisance::imu_delay, 0.05, 1}},
       {Channel::rate_x, Channel::rate_z, Channel::force_x}},
      {"accel_scale",
       "pitch and roll to both sides",
       {{"x", Nuisance::force_scale_x, 0.02, 1},
        {"y", Nuisance::force_scale_y, 0.02, 1},
        {"z", Nuisance::force_scale_z, 0.02, 1}},
       {Channel::force_x, Channel::force_y, Channel::force_z}},
      {"accel_bias",
       "pitch and roll to both sides",
       {{"x_m_s2", Nuisance::force_bias_x, 0.12, 1},
        {"y_m_s2", Nuisance::force_bias_y, 0.12, 1},
        {"z_m_s2", Nuisance::force_bias_z, 0.12, 1}},
       {Channel::force_x, Channel::force_y, Channel::force_z}},
      {"imu_misalignment",
       "pure yaw, level and pitched",
       {{"x_deg", Nuisance::imu_turn_x, 2, base::kRadiansPerDegree},
        {"y_deg", Nuisance::imu_turn_y, 2, base::kRadiansPerDegree},
        {"z_deg", Nuisance::imu_turn_z, 2, base::kRadiansPerDegree}},
       {Channel::rate_x, Channel::force_x}},
      {"tilt_offset",
       "lie still, then pitch and roll",
       {{"roll_deg", Nuisance::roll_offset, 1, base::kRadiansPerDegree},
        {"pitch_deg", Nuisance::pitch_offset, 1, base::kRadiansPerDegree}},
       {Channel::roll, Channel::pitch}},
      {"compass_deviation",
       "a full turn",
       {{"sine_deg", Nuisance::heading_sine, 4, base::kRadiansPerDegree},
        {"cosine_deg", Nuisance::heading_cosine, 4, base::kRadiansPerDegree}},
       {Channel::heading}},
      {"compass_lag",
       "turns at several rates to both sides",
       {{"tau_s", Nuisance::heading_delay, 0.2, 1}},
       {Channel::heading}},
      {"depth_scale",
       "hold two depths far apart",
       {{"scale", Nuisance::depth_scale, 0.06, 1}},
       {Channel::depth, Channel::gauge_depth}},
      {"gps_latency",
       "turns at the surface, fast and slow",
       {{"tau_s", Nuisance::fix_delay, 1, 1}},
       {Channel::north}},
      {"gps_lever_arm",
       "turn on the spot at the surface",
       {{"x_m", Nuisance::antenna_x, 0.45, 1}, {"y_m", Nuisance::antenna_y, 0.45, 1}},
       {Channel::north}},
      {"declination",
       "straight legs with fixes",
       {{"angle_deg", Nuisance::heading_offset, 4, base::kRadiansPerDegree}},
       {Channel::heading}},
      {"dvl_scale",
       "speed steps on reciprocal legs",
       {{"scale", Nuisance::doppler_scale, 0.03, 1}},
       {Channel::bottom_x, Channel::water_x}},
      {"dvl_latency",
       "speed steps and turns",
       {{"tau_s", Nuisance::doppler_delay, 0.1, 1}},
       {Channel::bottom_x, Channel::water_x}},
      {"dvl_misalignment",
       "straight legs with fixes",
       {{"z_deg", Nuisance::doppler_turn, 2, base::kRadiansPerDegree}},
       {Channel::bottom_x, Channel::water_x}},
      {"water_current",
       "reciprocal legs",
       {{"north_m_s", Nuisance::current_north, 0.06, 1}, {"east_m_s", Nuisance::current_east, 0.06, 1}},
       {Channel::north, Channel::bottom_x}},
      {"actuator_delay", "fast steps of the commands", {{"tau_s", Nuisance::actuator_delay, 0.1, 1}}, {}},
  };
  return kAll;
}

void add_effects(const config::Layout& layout, const std::set<std::string, std::less<>>& excluded,
                 CauseLibrary& library) {
  for (const sim::LayoutEffectDescription& about : sim::layout_effects()) {
    if (excluded.contains(about.name)) continue;
    std::vector<std::string> owners = sim::owners_of(layout, about);
    if (about.part == sim::LayoutPart::vehicle) owners = {""};
    const auto parameters = sim::parameters_for(layout, about);
    for (const std::string& of : owners) {
      Cause cause{.name = std::string(about.name),
                  .of = of,
                  .manoeuvre = std::string(about.manoeuvre.text()),
                  .parameters = {}};
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        const sim::EffectParameter& parameter = parameters[i];
        cause.parameters.push_back({.name = std::string(parameter.name),
                                    .typical = parameter.typical,
                                    .low = parameter.least,
                                    .high = parameter.greatest,
                                    .column = static_cast<Eigen::Index>(library.parameters.size())});
        sim::LayoutEffect effect{&about, of, std::vector<double>(parameters.size())};
        library.parameters.push_back(
            {.name = cause.words() + " " + std::string(parameter.name),
             .unit = {},
             .prior = 0,
             .prior_std = kUsualTolerance * parameter.typical,
             .low = parameter.least,
             .high = parameter.greatest,
             .key = {},
             .elements = {},
             .change =
                 [effect, i](config::Layout& changed, double value) {
                   sim::LayoutEffect here = effect;
                   here.values[i] = value;
                   changed = sim::changed_layout(std::move(changed), here);
                 },
             .is_of_actuator = cause.is_of_actuator(),
             .step = (parameter.least == 0 ? kOneSidedStep : kEffectStep) * parameter.typical});
      }
      library.causes.push_back(std::move(cause));
    }
  }
}

void add_instrument_errors(const RecordedMotion& recording, const std::set<std::string, std::less<>>& excluded,
                           CauseLibrary& library) {
  const auto first = static_cast<Eigen::Index>(library.parameters.size());
  for (const InstrumentError& error : instrument_errors()) {
    if (excluded.contains(error.name)) continue;
    const bool exists =
        error.needs.empty() || std::any_of(error.needs.begin(), error.needs.end(),
                                           [&](Channel channel) { return recording.has(channel); });
    if (!exists) {
      library.not_judged.push_back(std::string(error.name) + " was not judged: the recording has no " +
                                   std::string(identify::describe(error.needs.front()).name));
      continue;
    }
    Cause cause{.name = std::string(error.name),
                .of = {},
                .manoeuvre = std::string(error.manoeuvre),
                .parameters = {},
                .is_instrument = true};
    for (const InstrumentParameter& parameter : error.parameters) {
      cause.parameters.push_back({.name = std::string(parameter.name),
                                  .typical = parameter.typical,
                                  .per_unit = parameter.per_unit,
                                  .low = -kLargestStrength * parameter.typical,
                                  .high = kLargestStrength * parameter.typical,
                                  .column = first + static_cast<Eigen::Index>(parameter.nuisance)});
    }
    library.causes.push_back(std::move(cause));
  }
}

}  // namespace

std::vector<Eigen::Index> Cause::columns() const {
  std::vector<Eigen::Index> all;
  for (const CauseParameter& parameter : parameters) all.push_back(parameter.column);
  return all;
}

Eigen::Index CauseLibrary::columns() const {
  return static_cast<Eigen::Index>(parameters.size()) + identify::kNuisances;
}

CauseLibrary causes_of(const config::Layout& layout, const RecordedMotion& recording,
                       std::span<const std::string> excluded) {
  for (const std::string& name : excluded) {
    const bool is_instrument = std::any_of(instrument_errors().begin(), instrument_errors().end(),
                                           [&](const InstrumentError& error) { return error.name == name; });
    // An effect that no layout can be diagnosed with is left out already.
    if (!is_instrument && sim::find_layout_effect(name) == nullptr && !sim::make_effect(name))
      throw std::invalid_argument(name + " is no effect of a layout (navcal simulate --list-effects)");
  }
  const std::set<std::string, std::less<>> left_out(excluded.begin(), excluded.end());
  CauseLibrary library;
  library.parameters = identify::uncertain_parameters(layout);
  library.layout_numbers = library.parameters.size();
  add_effects(layout, left_out, library);
  add_instrument_errors(recording, left_out, library);
  return library;
}

}  // namespace navcal::diagnosis

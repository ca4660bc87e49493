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

/// Errors that no effect of the simulator is, with the typical value of each of their parameters.
struct OwnError {
  std::string_view name;
  double typical;
  std::string_view manoeuvre;
};
constexpr std::array<OwnError, 6> kOwnErrors{{{"imu_misalignment", 2, "pure yaw, level and pitched"},
                                              {"compass_deviation", 4, "a full turn"},
                                              {"dvl_scale", 0.03, "speed steps on reciprocal legs"},
                                              {"dvl_latency", 0.1, "speed steps and turns"},
                                              {"dvl_misalignment", 2, "straight legs with fixes"},
                                              {"actuator_delay", 0.1, "fast steps of the commands"}}};

/// An error of instruments. Typical strengths and manoeuvres are those of the simulator's effect of the same name,
/// where there is one.
struct InstrumentError {
  std::string_view name;
  /// That the fit estimates for each recording anyway. Empty: those of the simulator's effect, each reading's
  /// error by the motion at its instant.
  std::vector<std::pair<std::string_view, Nuisance>> parameters;
  std::vector<Channel> needs;   ///< one of them
  bool is_of_field_uT = false;  ///< needs the strength of the field besides
};

const std::vector<InstrumentError>& instrument_errors() {
  using enum Nuisance;
  using enum Channel;
  const std::vector<Channel> rates{rate_x, rate_y, rate_z}, forces{force_x, force_y, force_z},
      doppler{bottom_x, water_x};
  // Those of the simulator stand first: the nuisances follow all parameters of the fit.
  static const std::vector<InstrumentError> kAll{
      {"hard_iron", {}, {heading}, true},
      {"soft_iron", {}, {heading}, true},
      {"compass_misalignment", {}, {heading}, true},
      {"tilt_slosh", {}, {roll, pitch}},
      {"gyro_cross_axis", {}, rates},
      {"gyro_nonlinearity", {}, rates},
      {"gyro_scale", {{"scale_ax", rate_scale_x}, {"scale_by", rate_scale_y}, {"scale_az", rate_scale_z}}, rates},
      {"gyro_drift",
       {{"deg_per_s2_ax", rate_drift_x}, {"deg_per_s2_by", rate_drift_y}, {"deg_per_s2_az", rate_drift_z}},
       rates},
      {"accel_bias", {{"x_m_s2", force_bias_x}, {"y_m_s2", force_bias_y}, {"z_m_s2", force_bias_z}}, forces},
      {"accel_scale", {{"x", force_scale_x}, {"y", force_scale_y}, {"z", force_scale_z}}, forces},
      {"imu_misalignment",
       {{"x_deg", imu_turn_x}, {"y_deg", imu_turn_y}, {"z_deg", imu_turn_z}},
       {rate_x, force_x}},
      {"imu_latency", {{"tau_s", imu_delay}}, {rate_x, rate_z, force_x}},
      {"tilt_offset", {{"roll_deg", roll_offset}, {"pitch_deg", pitch_offset}}, {roll, pitch}},
      {"compass_deviation", {{"sine_deg", heading_sine}, {"cosine_deg", heading_cosine}}, {heading}},
      {"compass_lag", {{"tau_s", heading_delay}}, {heading}},
      {"declination", {{"angle_deg", heading_offset}}, {heading}},
      {"depth_scale", {{"scale", depth_scale}}, {depth, gauge_depth}},
      {"gps_latency", {{"tau_s", fix_delay}}, {north}},
      {"gps_lever_arm", {{"x_m", antenna_x}, {"y_m", antenna_y}}, {north}},
      {"dvl_scale", {{"scale", doppler_scale}}, doppler},
      {"dvl_latency", {{"tau_s", doppler_delay}}, doppler},
      {"dvl_misalignment", {{"z_deg", doppler_turn}}, doppler},
      {"water_current", {{"north_m_s", current_north}, {"east_m_s", current_east}}, {north, bottom_x}},
      {"actuator_delay", {{"tau_s", actuator_delay}}, {}}};
  return kAll;
}

/// Whether one of some channels was recorded.
bool has_any(const RecordedMotion& recording, const std::vector<Channel>& of) {
  return std::ranges::any_of(of, [&](Channel channel) { return recording.has(channel); });
}

/// The gyro of a parameter, by its name, where it is one of a gyro: "scale_ax", "by_from_z".
std::optional<Channel> gyro_of(std::string_view parameter) {
  using enum Channel;
  constexpr std::array<std::pair<std::string_view, Channel>, 4> kGyros{
      {{"ax", rate_x}, {"by", rate_y}, {"az", rate_z}, {"bz", second_yaw_rate}}};
  for (const auto& [name, channel] : kGyros) {
    if (parameter.starts_with(name) || parameter.ends_with(name)) return channel;
  }
  return std::nullopt;
}

/// Adds a number of a simulator's effect to a cause and to the fit. `fitted`: the change that it makes.
void add_parameter(const sim::EffectParameter& of, double low, double high, identify::Parameter fitted,
                   Cause& cause, CauseLibrary& library) {
  cause.parameters.push_back({.name = std::string(of.name),
                              .typical = of.typical,
                              .low = low,
                              .high = high,
                              .column = static_cast<Eigen::Index>(library.parameters.size())});
  fitted.name = cause.words() + " " + std::string(of.name);
  fitted.prior_std = kUsualTolerance * of.typical;
  fitted.low = of.least;
  fitted.high = of.greatest;
  library.parameters.push_back(std::move(fitted));
}

void add_effects(const config::Layout& layout, const std::set<std::string, std::less<>>& excluded,
                 CauseLibrary& library) {
  for (const sim::LayoutEffectDescription& about : sim::layout_effects()) {
    if (excluded.contains(about.name)) continue;
    std::vector<std::string> owners = sim::owners_of(layout, about);
    if (about.part == sim::LayoutPart::vehicle) owners = {""};
    const auto parameters = sim::parameters_for(layout, about);
    for (const std::string& of : owners) {
      Cause cause{.name = std::string(about.name), .of = of, .manoeuvre = std::string(about.manoeuvre.text())};
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        const sim::EffectParameter& parameter = parameters[i];
        sim::LayoutEffect effect{&about, of, std::vector<double>(parameters.size())};
        add_parameter(parameter, parameter.least, parameter.greatest,
                      {.change =
                           [effect, i](config::Layout& changed, double value) {
                             sim::LayoutEffect here = effect;
                             here.values[i] = value;
                             changed = sim::changed_layout(std::move(changed), here);
                           },
                       .is_of_actuator = cause.is_of_actuator(),
                       .step = (parameter.least == 0 ? kOneSidedStep : kEffectStep) * parameter.typical},
                      cause, library);
      }
      library.causes.push_back(std::move(cause));
    }
  }
}

/// Adds the parameters of a simulated error to those of the fit, without those of gyros that are not there.
void add_simulated(const sim::EffectDescription& about, const RecordedMotion& recording, Cause& cause,
                   CauseLibrary& library) {
  for (std::size_t i = 0; i < about.parameters.size(); ++i) {
    const sim::EffectParameter& parameter = about.parameters[i];
    const auto gyro = about.name.starts_with("gyro_") ? gyro_of(parameter.name) : std::nullopt;
    if (gyro && !recording.has(*gyro)) continue;
    const double most = kLargestStrength * parameter.typical;
    add_parameter(parameter, -most, most, {.of_instruments = {{about.name, i}}}, cause, library);
  }
}

void add_instrument_errors(const RecordedMotion& recording, const std::set<std::string, std::less<>>& excluded,
                           CauseLibrary& library) {
  for (const InstrumentError& error : instrument_errors()) {
    const bool is_replaced =
        error.name == "compass_deviation" && recording.field_uT > 0 && !excluded.contains("hard_iron");
    for (const auto& [name, nuisance] : error.parameters)
      if (is_replaced) library.replaced.push_back(nuisance);
    if (excluded.contains(error.name) || is_replaced || (error.is_of_field_uT && recording.field_uT <= 0))
      continue;
    if (!error.needs.empty() && !has_any(recording, error.needs)) {
      library.not_judged.push_back(std::string(error.name) + " was not judged: the recording has no " +
                                   std::string(identify::describe(error.needs.front()).name));
      continue;
    }
    const auto own = std::ranges::find(kOwnErrors, error.name, &OwnError::name);
    const auto simulated = own == kOwnErrors.end() ? sim::make_effect(error.name) : nullptr;
    Cause cause{.name = std::string(error.name),
                .manoeuvre = std::string(simulated ? simulated->description().manoeuvre.text() : own->manoeuvre),
                .is_instrument = true};
    if (error.parameters.empty()) add_simulated(simulated->description(), recording, cause, library);
    const auto typical_of = [&](std::string_view name) {
      if (!simulated) return own->typical;
      const auto& all = simulated->description().parameters;
      return std::ranges::find(all, name, &sim::EffectParameter::name)->typical;
    };
    for (const auto& [name, nuisance] : error.parameters) {
      const double typical = typical_of(name);
      cause.parameters.push_back(
          {.name = std::string(name),
           .typical = typical,
           .per_unit = name.find("deg") == name.npos ? 1 : base::kRadiansPerDegree,
           .low = -kLargestStrength * typical,
           .high = kLargestStrength * typical,
           .column = static_cast<Eigen::Index>(library.parameters.size()) + static_cast<Eigen::Index>(nuisance)});
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
    const bool is_instrument =
        std::ranges::find(instrument_errors(), name, &InstrumentError::name) != instrument_errors().end();
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

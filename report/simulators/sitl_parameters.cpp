// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "base/angles.h"
#include "base/reference_instruments.h"
#include "report/simulators/transfer.h"

// Sources are named at the head of representation.cpp. Body axes of ArduPilot are those of navcal: x forward, y to
// starboard, z down.
namespace navcal::report {
namespace {

struct SitlParameter {
  std::string name;
  double value = 0;
};

/// What the conversions know.
struct SitlContext {
  const CorrectedModel& model;
  const Transfer& transfer;
};

/// Appends the parameters of an effect; answers why the effect cannot be represented, or an empty text.
using SitlConversion = std::string (*)(const TransferredEffect&, const SitlContext&, std::vector<SitlParameter>&);

// SITL has several instruments of a kind by default. All of them get the same error, so that whichever the
// autopilot uses shows it.
constexpr std::array kSitlCompasses{1, 2, 3};
constexpr std::array kSitlImus{1, 2};

constexpr double kSitlMilligaussPerMicrotesla = 10;
constexpr double kSitlGpsLag_ms = 100;        ///< SIM_GPS1_LAG_MS by default
constexpr double kSitlMostGpsLag_ms = 3800;   ///< 19 of the 20 fixes that are kept, 5 a second
constexpr double kSitlMostMagDelay_ms = 490;  ///< 49 of the 50 readings that are kept, 100 a second
/// The field of SIM_MAG_ALY falls with the cube of the height above ground over this height, m: not at all.
constexpr double kSitlAnomalyHeight_m = 1e6;
// Warm-up of the electronics in navcal's simulator (sim/instruments/electronics.h), in water at the reference
// temperature.
constexpr double kSitlAboveWater_C = 8;
constexpr double kSitlSettles_s = 200;

void append_vector(std::vector<SitlParameter>& to, const std::string& name, const Eigen::Vector3d& value) {
  constexpr std::array kAxes{"_X", "_Y", "_Z"};
  for (Eigen::Index i = 0; i < 3; ++i) to.push_back({name + kAxes[static_cast<std::size_t>(i)], value[i]});
}

Eigen::Vector3d sitl_vector(const TransferredEffect& effect, std::string_view unit) {
  const auto component = [&](char axis) { return effect[fmt::format("{}{}", axis, unit)]; };
  return {component('x'), component('y'), component('z')};
}

std::string sitl_hard_iron(const TransferredEffect& effect, const SitlContext&, std::vector<SitlParameter>& to) {
  for (const int n : kSitlCompasses) {
    append_vector(to, fmt::format("SIM_MAG{}_OFS", n), -kSitlMilligaussPerMicrotesla * sitl_vector(effect, "_uT"));
  }
  return {};
}

/// Inverse of 1 + S: the matrix that SITL inverts. Empty when it does not exist.
std::optional<Eigen::Matrix3d> inverse_soft_iron(const TransferredEffect& effect) {
  Eigen::Matrix3d soft_iron;
  soft_iron << 1 + effect["xx"], effect["xy"], effect["xz"],  //
      effect["xy"], 1 + effect["yy"], effect["yz"],           //
      effect["xz"], effect["yz"], 1 + effect["zz"];
  constexpr double kLeastDeterminant = 1e-3;
  if (std::abs(soft_iron.determinant()) < kLeastDeterminant) return std::nullopt;
  return soft_iron.inverse();
}

std::string sitl_soft_iron(const TransferredEffect& effect, const SitlContext&, std::vector<SitlParameter>& to) {
  const auto inverse = inverse_soft_iron(effect);
  if (!inverse) return "1 + S has no inverse";
  for (const int n : kSitlCompasses) {
    append_vector(to, fmt::format("SIM_MAG{}_DIA", n), inverse->diagonal());
    append_vector(to, fmt::format("SIM_MAG{}_ODI", n), {(*inverse)(0, 1), (*inverse)(0, 2), (*inverse)(1, 2)});
  }
  return {};
}

std::string sitl_motor_field(const TransferredEffect& effect, const SitlContext& context,
                             std::vector<SitlParameter>& to) {
  Eigen::Vector3d slope = sitl_vector(effect, "_uT_per_A");
  // SITL adds the motor's field before the soft iron, navcal after it.
  if (const auto* const soft_iron = context.transfer.find("soft_iron")) {
    if (const auto inverse = inverse_soft_iron(*soft_iron)) slope = *inverse * slope;
  }
  append_vector(to, "SIM_MAG_MOT", kSitlMilligaussPerMicrotesla * slope);
  return {};
}

std::string sitl_declination(const TransferredEffect& effect, const SitlContext& context,
                             std::vector<SitlParameter>& to) {
  if (!context.model.diagnosis.field) return "the diagnosis states no field of the Earth";
  const auto [north, east, down] = context.model.diagnosis.field->north_east_down_uT;
  const double angle = effect["angle_deg"] * base::kRadiansPerDegree, c = std::cos(angle), s = std::sin(angle);
  append_vector(
      to, "SIM_MAG_ALY",
      kSitlMilligaussPerMicrotesla * Eigen::Vector3d((c - 1) * north - s * east, s * north + (c - 1) * east, 0));
  to.push_back({"SIM_MAG_ALY_HGT", kSitlAnomalyHeight_m});
  return {};
}

std::string sitl_compass_lag(const TransferredEffect& effect, const SitlContext&, std::vector<SitlParameter>& to) {
  const double delay_ms = std::round(1000 * effect["tau_s"]);
  if (delay_ms > kSitlMostMagDelay_ms)
    return fmt::format("SITL keeps readings of the compass for {:g} ms only", kSitlMostMagDelay_ms);
  to.push_back({"SIM_MAG_DELAY", delay_ms});
  return {};
}

/// The channels of gyros A and B as two gyros of three axes: x and y are measured once, z twice.
std::array<Eigen::Vector3d, kSitlImus.size()> sitl_gyros(const TransferredEffect& effect,
                                                         std::string_view prefix) {
  const auto channel = [&](std::string_view name) { return effect[fmt::format("{}_{}", prefix, name)]; };
  const double x = channel("ax"), y = channel("by");
  return {Eigen::Vector3d(x, y, channel("az")), Eigen::Vector3d(x, y, channel("bz"))};
}

std::string sitl_gyro_scale(const TransferredEffect& effect, const SitlContext&, std::vector<SitlParameter>& to) {
  const auto scales = sitl_gyros(effect, "scale");
  for (std::size_t i = 0; i < kSitlImus.size(); ++i)
    append_vector(to, fmt::format("SIM_GYR{}_SCALE", kSitlImus[i]), 100 * scales[i]);
  return {};
}

std::string sitl_gyro_temperature(const TransferredEffect& effect, const SitlContext&,
                                  std::vector<SitlParameter>& to) {
  constexpr double kReference_C = base::reference::kTemperature_C;
  // SITL's polynomial is about the middle of TMIN and TMAX.
  constexpr double kHalfRange_C = 15;
  constexpr double kPolynomialScale = 1e6;
  to.insert(to.end(), {{"SIM_IMUT_FIXED", 0},
                       {"SIM_IMUT_START", kReference_C},
                       {"SIM_IMUT_END", kReference_C + kSitlAboveWater_C},
                       {"SIM_IMUT_TCONST", kSitlSettles_s}});
  const auto slopes = sitl_gyros(effect, "deg_per_s_per_C");
  for (std::size_t i = 0; i < kSitlImus.size(); ++i) {
    const std::string group = fmt::format("SIM_IMUT{}_", kSitlImus[i]);
    to.insert(to.end(), {{group + "ENABLE", 1},
                         {group + "TMIN", kReference_C - kHalfRange_C},
                         {group + "TMAX", kReference_C + kHalfRange_C}});
    append_vector(to, group + "GYR1", kPolynomialScale * base::kRadiansPerDegree * slopes[i]);
  }
  return {};
}

std::string sitl_accel_bias(const TransferredEffect& effect, const SitlContext&, std::vector<SitlParameter>& to) {
  for (const int n : kSitlImus) append_vector(to, fmt::format("SIM_ACC{}_BIAS", n), sitl_vector(effect, "_m_s2"));
  return {};
}

std::string sitl_accel_scale(const TransferredEffect& effect, const SitlContext&, std::vector<SitlParameter>& to) {
  const Eigen::Vector3d factor = Eigen::Vector3d::Ones() + sitl_vector(effect, "");
  for (const int n : kSitlImus) append_vector(to, fmt::format("SIM_ACC{}_SCAL", n), factor.cwiseInverse());
  return {};
}

std::string sitl_gps_latency(const TransferredEffect& effect, const SitlContext&, std::vector<SitlParameter>& to) {
  const double lag_ms = std::round(kSitlGpsLag_ms + 1000 * effect["tau_s"]);
  if (lag_ms > kSitlMostGpsLag_ms) return fmt::format("SITL keeps fixes for {:g} ms only", kSitlMostGpsLag_ms);
  to.push_back({"SIM_GPS1_LAG_MS", lag_ms});
  return {};
}

std::string sitl_gps_lever_arm(const TransferredEffect& effect, const SitlContext&,
                               std::vector<SitlParameter>& to) {
  append_vector(to, "SIM_GPS1_POS", {effect["x_m"], effect["y_m"], 0});
  return {};
}

std::string sitl_water_current(const TransferredEffect& effect, const SitlContext&,
                               std::vector<SitlParameter>& to) {
  const double north = effect["north_m_s"], east = effect["east_m_s"];
  const double from_rad = base::positive_angle(std::atan2(-east, -north));
  constexpr double kSameAtAllHeights = 1;
  to.insert(to.end(), {{"SIM_WIND_SPD", std::hypot(north, east)},
                       {"SIM_WIND_DIR", from_rad * base::kDegreesPerRadian},
                       {"SIM_WIND_DIR_Z", 0},
                       {"SIM_WIND_TURB", 0},
                       {"SIM_WIND_T", kSameAtAllHeights}});
  return {};
}

std::string sitl_buoyancy(const TransferredEffect& effect, const SitlContext&, std::vector<SitlParameter>& to) {
  to.push_back({"SIM_BUOYANCY", effect["force_N"]});
  return {};
}

struct SitlRow {
  std::string_view effect;
  SitlConversion convert;
};
constexpr std::array<SitlRow, 13> kSitlRows{{{"accel_bias", sitl_accel_bias},
                                             {"accel_scale", sitl_accel_scale},
                                             {"buoyancy", sitl_buoyancy},
                                             {"compass_lag", sitl_compass_lag},
                                             {"declination", sitl_declination},
                                             {"gps_latency", sitl_gps_latency},
                                             {"gps_lever_arm", sitl_gps_lever_arm},
                                             {"gyro_scale", sitl_gyro_scale},
                                             {"gyro_temperature", sitl_gyro_temperature},
                                             {"hard_iron", sitl_hard_iron},
                                             {"motor_field", sitl_motor_field},
                                             {"soft_iron", sitl_soft_iron},
                                             {"water_current", sitl_water_current}}};

std::string convert_for_sitl(const TransferredEffect& effect, const SitlContext& context,
                             std::vector<SitlParameter>& to) {
  for (const SitlRow& row : kSitlRows) {
    if (row.effect == effect.name()) return row.convert(effect, context, to);
  }
  return "this version of navcal has no conversion for it";
}

/// "SIM_BUOYANCY 0.4": no sign at zero, all digits.
std::string sitl_line(const SitlParameter& parameter) {
  return fmt::format("{} {}\n", parameter.name, parameter.value + 0.0);
}

}  // namespace

SimulatorFile sitl_parameters(const CorrectedModel& model) {
  constexpr std::size_t kLongestLine = 90;
  constexpr std::string_view kPrefix = "# ";
  Transfer transfer(model.diagnosis, Simulator::sitl);
  std::string body;
  const std::vector<TransferredEffect> effects = transfer.effects();
  for (const TransferredEffect& effect : effects) {
    std::vector<SitlParameter> parameters;
    if (auto reason = convert_for_sitl(effect, {model, transfer}, parameters); !reason.empty()) {
      transfer.leave_out(effect.name(), std::move(reason));
      continue;
    }
    body += '\n' + comment_lines(about(effect, Simulator::sitl), kPrefix, kLongestLine);
    for (const SitlParameter& parameter : parameters) body += sitl_line(parameter);
  }
  std::vector<std::string> head = about(model, transfer);
  head.emplace_back(
      "Parameters of ArduSub 4.7. Older versions call some of them otherwise (docs/simulator-export.md).");
  if (transfer.find("hard_iron") != nullptr)
    head.emplace_back(
        "An autopilot whose COMPASS_OFS are zero takes SIM_MAGn_OFS for its own calibration at start, which hides "
        "the effect: load this file into a running simulation.");
  std::string text;
  for (const std::string& paragraph : head) text += comment_lines(paragraph, kPrefix, kLongestLine);
  return {text + body, summary_of(model.diagnosis, transfer)};
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "base/angles.h"
#include "report/vehicle_report.h"

namespace navcal::report {
namespace {

using VehicleJson = nlohmann::ordered_json;

VehicleJson or_null(const std::optional<double>& value) { return value ? VehicleJson(*value) : VehicleJson(); }

VehicleJson statics_json(const sim::Statics& statics) {
  return {{"mass_kg", statics.mass_kg},
          {"displaced_kg", statics.displaced_kg},
          {"net_buoyancy_N", statics.net_buoyancy_N},
          {"trim_roll_deg", statics.roll_rad * base::kDegreesPerRadian},
          {"trim_pitch_deg", statics.pitch_rad * base::kDegreesPerRadian},
          {"metacentric_height_m", statics.metacentric_height_m},
          {"roll_period_s", or_null(statics.roll_period_s)},
          {"pitch_period_s", or_null(statics.pitch_period_s)},
          {"roll_damping_ratio", statics.roll_damping_ratio},
          {"pitch_damping_ratio", statics.pitch_damping_ratio}};
}

VehicleJson speeds_json(const std::vector<sim::SteadySpeed>& speeds) {
  VehicleJson out = VehicleJson::array();
  for (const sim::SteadySpeed& steady : speeds)
    out.push_back({{"what", steady.what}, {"force_N", steady.force_N}, {"speed_m_s", or_null(steady.speed_m_s)}});
  return out;
}

VehicleJson motion_json(const sim::SteadyMotion& motion) {
  if (!motion.failure.empty()) return {{"what", motion.what}, {"failure", motion.failure}};
  return {{"what", motion.what},
          {"steady", motion.is_steady},
          {"speed_m_s", motion.speed_m_s},
          {"surge_m_s", motion.surge_m_s},
          {"roll_deg", motion.roll_rad * base::kDegreesPerRadian},
          {"pitch_deg", motion.pitch_rad * base::kDegreesPerRadian},
          {"turn_deg_s", motion.turn_rad_s * base::kDegreesPerRadian},
          {"radius_m", or_null(motion.radius_m)},
          {"path_deg", motion.path_rad * base::kDegreesPerRadian},
          {"angle_of_attack_deg", motion.attack_rad * base::kDegreesPerRadian}};
}

template <class Found>
VehicleJson allocation_json(const Found& found, double speed_m_s) {
  constexpr std::array<const char*, 6> kNames{"surge", "sway", "heave", "roll", "pitch", "yaw"};
  constexpr std::array<const char*, 3> kWords{"no", "with others", "alone"};
  VehicleJson commands;
  for (std::size_t i = 0; i < 6; ++i) commands[kNames[i]] = kWords[static_cast<std::size_t>(found.commands[i])];
  return {{"speed_m_s", speed_m_s},       {"rank", found.rank},
          {"condition", found.condition}, {"singular_values", found.singular_values},
          {"commanded", commands},        {"missing", found.missing}};
}

}  // namespace

std::string vehicle_check_json(const config::Layout& layout, const sim::Assessment& found) {
  VehicleJson out{
      {"name", layout.name}, {"simulable", found.cannot_simulate.empty()}, {"reason", found.cannot_simulate}};
  if (found.cannot_simulate.empty()) {
    out["statics"] = statics_json(found.statics);
    out["ahead"] = speeds_json(found.ahead);
    out["downwards"] = speeds_json(found.downwards);
    out["motions"] = VehicleJson::array();
    for (const sim::SteadyMotion& motion : found.motions) out["motions"].push_back(motion_json(motion));
    out["allocation"] = {allocation_json(found.at_rest, 0), allocation_json(found.under_way, found.under_way_m_s)};
  }
  out["odd"] = VehicleJson::array();
  for (const sim::Oddity& oddity : found.odd)
    out["odd"].push_back({{"key", oddity.key}, {"message", oddity.message}});
  return out.dump() + "\n";
}

std::string conventions_json(const identify::ConventionCheck& found) {
  VehicleJson out{
      {"conventions", VehicleJson::array()}, {"not_checked", found.not_checked}, {"untold", found.untold}};
  for (const identify::Convention& convention : found.found)
    out["conventions"].push_back({{"name", convention.name},
                                  {"what", convention.what},
                                  {"probability", convention.probability},
                                  {"sentence", convention.sentence}});
  return out.dump() + "\n";
}

}  // namespace navcal::report

// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "record/json/put_members.h"
#include "report/vehicle_report.h"

namespace navcal::identify {

NAVCAL_JSON_MEMBERS(Convention, name, what, probability, sentence)

}  // namespace navcal::identify

namespace navcal::sim {

NAVCAL_JSON_MEMBERS(SteadySpeed, what, force_N, speed_m_s)
NAVCAL_JSON_MEMBERS(Oddity, key, message)

static void to_json(nlohmann::ordered_json& json, const Statics& statics) {
  NAVCAL_PUT_MEMBERS(json, statics, mass_kg, displaced_kg, net_buoyancy_N);
  json["trim_roll_deg"] = statics.roll_rad * base::kDegreesPerRadian;
  json["trim_pitch_deg"] = statics.pitch_rad * base::kDegreesPerRadian;
  NAVCAL_PUT_MEMBERS(json, statics, metacentric_height_m, roll_period_s, pitch_period_s, roll_damping_ratio,
                     pitch_damping_ratio);
}

static void to_json(nlohmann::ordered_json& json, const SteadyMotion& motion) {
  if (!motion.failure.empty()) return NAVCAL_PUT_MEMBERS(json, motion, what, failure);
  json = {{"what", motion.what},
          {"steady", motion.is_steady},
          {"speed_m_s", motion.speed_m_s},
          {"surge_m_s", motion.surge_m_s},
          {"roll_deg", motion.roll_rad * base::kDegreesPerRadian},
          {"pitch_deg", motion.pitch_rad * base::kDegreesPerRadian},
          {"turn_deg_s", motion.turn_rad_s * base::kDegreesPerRadian},
          {"radius_m", motion.radius_m},
          {"path_deg", motion.path_rad * base::kDegreesPerRadian},
          {"angle_of_attack_deg", motion.attack_rad * base::kDegreesPerRadian}};
}

}  // namespace navcal::sim

namespace navcal::report {
namespace {

using VehicleJson = nlohmann::ordered_json;

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
    NAVCAL_PUT_MEMBERS(out, found, statics, ahead, downwards, motions);
    out["allocation"] = {allocation_json(found.at_rest, 0), allocation_json(found.under_way, found.under_way_m_s)};
  }
  out["odd"] = found.odd;
  return out.dump() + "\n";
}

std::string conventions_json(const identify::ConventionCheck& found) {
  VehicleJson out{{"conventions", found.found}};
  NAVCAL_PUT_MEMBERS(out, found, not_checked, untold);
  return out.dump() + "\n";
}

}  // namespace navcal::report

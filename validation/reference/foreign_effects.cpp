// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/effects.h"
#include "validation/reference/instrument.h"

namespace navcal::reference {

std::span<const EffectKind> foreign_effects() {
  using D = ParameterDeviations;
  constexpr double kPerHour = 1.0 / 3600;
  static const std::vector<EffectKind> all{
      effect_kind("crossflow_depth", Trace::fins, {"per_m2"}, {.typical = 0.05, .sign = Sign::positive},
                  [](D& d) { return &d.vehicle.crossflow_per_m2; }),
      effect_kind("torque_leak", Trace::roll, {"share"}, {.typical = 0.6},
                  [](D& d) { return &d.vehicle.torque_leak; }),
      effect_kind("tidal_current", Trace::drift, {"north_m_s", "east_m_s"}, {.typical = 0.1, .group = 2},
                  [](D& d) { return d.vehicle.tide_m_s.data(); }),
      effect_kind("battery_sag", Trace::supply, {"per_Ah"},
                  {.typical = 0.6, .si = kPerHour, .sign = Sign::positive},
                  [](D& d) { return &d.vehicle.sag_per_C; }),
      effect_kind("fin_stall", Trace::fins, {"loss"}, {.typical = 0.8, .sign = Sign::not_negative},
                  [](D& d) { return &d.vehicle.stall_loss; }),
      effect_kind("fouling", Trace::thrust, {"per_h"}, {.typical = 2, .si = kPerHour, .sign = Sign::positive},
                  [](D& d) { return &d.vehicle.fouling_per_s; }),
      effect_kind("surface_waves", Trace::waves, {"force_N"}, {.typical = 1.5},
                  [](D& d) { return &d.vehicle.wave_N; }),
      effect_kind("heading_lag", Trace::heading, {"north_s", "east_s"}, {.typical = 0.3, .group = 2},
                  [](D& d) { return d.compass.lag_by_heading_s.data(); }),
      effect_kind("magnetometer_saturation", Trace::field, {"per_uT2"},
                  {.typical = 2e-5, .sign = Sign::not_negative},
                  [](D& d) { return &d.compass.saturation_per_uT2; }),
      effect_kind("gyro_thermal_twist", Trace::rates, {"x_deg_per_C2", "y_deg_per_C2", "z_deg_per_C2"},
                  {.typical = 0.1, .group = 3, .si = kDegree},
                  [](D& d) { return d.card.gyro_twist_rad_per_K2.data(); }),
      effect_kind("gyro_popcorn", Trace::rates, {"deg_per_s"}, {.typical = 0.4, .si = kDegree},
                  [](D& d) { return &d.card.gyro_jump_rad_s; }),
      effect_kind("depth_hysteresis", Trace::depth, {"width_m"}, {.typical = 0.3, .sign = Sign::not_negative},
                  [](D& d) { return &d.card.depth_backlash_m; }),
      effect_kind("gps_multipath", Trace::fixes, {"north_m", "east_m"}, {.typical = 2, .group = 2},
                  [](D& d) { return d.gps.multipath_m.data(); }),
  };
  return all;
}

}  // namespace navcal::reference

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/diagnose_layout.h"
#include "sim/layout/effects/layout_effects.h"
#include "tests/identify/identification_case.h"

namespace navcal::diagnosis {

/// The small vehicle with four thrusters, its numbers exact.
inline identify::VehicleCase micro() {
  identify::VehicleCase of = identify::vehicle_case("micro");
  of.prior.uncertainties.clear();
  return of;
}

inline identify::RecordedMotion recording(const identify::VehicleCase& of, const config::Layout& truth,
                                          std::uint64_t seed) {
  return identify::draw_recording(of, truth, 24, seed, 0.05);
}

inline config::Layout changed(const config::Layout& layout, std::string_view effect, const std::string& part,
                              std::vector<double> values) {
  return sim::changed_layout(layout, {sim::find_layout_effect(effect), part, std::move(values)});
}

inline gap::Diagnosis diagnosis_of(const identify::VehicleCase& of, const config::Layout& truth) {
  return diagnose({.layout = of.prior, .excluded = {}, .threads = 1},
                  {recording(of, truth, 1),
                   {recording(of, truth, 21)},
                   {recording(of, of.prior, 11), recording(of, of.prior, 31)}},
                  [](std::string_view, double) {});
}

}  // namespace navcal::diagnosis

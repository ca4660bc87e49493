// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "validation/arms.h"
#include "validation/reference/mission.h"

namespace navcal::validation {

/// 2026-11-10, 09:00 UTC, an odd fraction after the second: when the first mission begins that is nowhere else.
inline constexpr std::int64_t kTrialBegin_ns = 1'794'301'200'370'000'000;
inline constexpr std::int64_t kDay_ns = 86'400'000'000'000;
/// Length of the brief missions.
inline constexpr int kBriefMinutes = 3;

/// A to be diagnosed, B and C to be held out: the same for every case of a kind, so that nothing in them tells of
/// the case. The usual ones (10 or 3 minutes) are meant to excite what the specification's column "what breaks the
/// tie" asks for: turns both ways at several rates and speeds, tilt of both signs, steps of speed at one heading,
/// two depths, doublets of fins, reciprocal legs at the surface with fixes. The poor ones are a straight line
/// each.
[[nodiscard]] std::array<reference::Mission, 3> trial_missions(MissionKind kind, int minutes);

/// Place and date of the missions of a case.
struct TrialPlace {
  reference::Anchorage anchorage;
  reference::Waters waters;
  std::int64_t begin_ns = 0;  ///< UTC of the first mission; the others follow a day later each
};

/// So many are drawn for a trial: null missions of the diagnosis serve all cases of a place.
inline constexpr int kTrialPlaces = 12;

/// Uniform on the sphere within 80 degrees of latitude, from 2025 to 2029, with the field of the World Magnetic
/// Model; water of 2 to 28 C and 998 to 1028 kg/m3.
[[nodiscard]] TrialPlace drawn_place(std::uint64_t seed, int number);

/// The mission, swum there. Its own day counts from that of the place.
[[nodiscard]] reference::Mission at_place(reference::Mission mission, const TrialPlace& place);

}  // namespace navcal::validation

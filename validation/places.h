// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "validation/reference/mission.h"

namespace navcal::validation {

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

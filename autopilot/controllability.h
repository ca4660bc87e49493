// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "autopilot/allocation.h"

namespace navcal::autopilot {

inline constexpr std::array<const char*, 6> kDegreesOfFreedom{"surge", "sway", "heave", "roll", "pitch", "yaw"};

enum class Command { no, with_others, alone };

/// Which degrees of freedom actuators command, by the singular values of the allocation matrix with rows scaled as
/// Allocator::row_scales() and columns by what each actuator gives at most. Singular values below 1e-6 of the
/// largest count as zero. A degree of freedom is commanded alone when its unit vector lies in the range of the
/// matrix.
struct Controllability {
  int rank = 0;
  double condition = 0;  ///< largest over smallest singular value that is not zero
  std::array<double, 6> singular_values{};
  std::array<Command, 6> commands{};
  std::vector<std::string> missing;  ///< in words: "sway, heave cannot be commanded", "roll and yaw only together"
};

/// At this velocity: surfaces give nothing at rest.
[[nodiscard]] Controllability controllability(const Allocator& allocator, const Wrench& velocity);

}  // namespace navcal::autopilot

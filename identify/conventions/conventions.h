// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/layout.h"
#include "identify/data/recorded_motion.h"

namespace navcal::identify {

/// One convention of units, signs or frames that the recordings break.
struct Convention {
  std::string name;  ///< "sign", "axis_swapped", ...: as docs/vehicles.md lists them
  std::string what;  ///< channel or part: "rate_z", "rates", "thruster.2"
  double probability = 0;
  std::string sentence;
};

struct ConventionCheck {
  std::vector<Convention> found;         ///< in the order in which they were mended; empty: nothing is wrong
  std::vector<std::string> not_checked;  ///< with what is missing, in words
  std::vector<std::string> untold;       ///< errors with which the recordings agree as well: "rate_x reversed"
  std::size_t told = 0;                  ///< errors that would show, and do not
};

/// Whether channels agree with each other, and motion with commands by the layout: each known error of
/// conventions is undone in turn, and the one that makes them agree is named where it is 90 % certain, at most
/// four. Recordings are of one vehicle with the same conventions.
[[nodiscard]] ConventionCheck check_conventions(const config::Layout& layout, std::vector<RecordedMotion> motions,
                                                const std::function<void(double)>& progress);

}  // namespace navcal::identify

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "validation/reference/thrusters/plan.h"

namespace navcal::reference::thrusters::testing {

inline std::string shipped_text(const std::string& name) {
  std::ifstream file(NAVCAL_SOURCE_DIR "/share/vehicles/" + name + ".toml");
  return {std::istreambuf_iterator<char>(file), {}};
}
inline Plan shipped_plan(const std::string& name) { return plan_of(shipped_text(name)); }

/// The shipped layouts whose only actuators are thrusters.
inline constexpr const char* kThrusterLayouts[] = {"bluerov2", "bluerov2-heavy", "micro-auv"};

}  // namespace navcal::reference::thrusters::testing

// SPDX-License-Identifier: Apache-2.0
// Any bytes as a layout: problems, or a layout that is written and read back the same and whose model takes a
// step.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "config/layout/layout_file.h"
#include "sim/layout/layout_vehicle.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::layout_target {

NAVCAL_FUZZ(layout) {
  using namespace navcal;
  std::vector<config::Problem> problems;
  const auto layout = config::read_layout({reinterpret_cast<const char*>(data), size}, problems);
  if (!problems.empty()) return 0;
  const std::string written = config::layout_file(layout);
  // A layout close to the greatest size may be written longer than it was read.
  if (written.size() <= config::kMaxLayout) {
    const auto again = config::read_layout(written, problems);
    if (!problems.empty() || again.thrusters.size() != layout.thrusters.size()) std::abort();
  }
  const sim::LayoutVehicle vehicle(layout);
  const auto positions = sim::ActuatorValues::neutral(layout);
  (void)vehicle.step({}, sim::follow(layout, positions, positions, 0.01), 0.01);
  return 0;
}

}  // namespace navcal::fuzz::layout_target

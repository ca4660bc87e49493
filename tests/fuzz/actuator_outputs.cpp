// SPDX-License-Identifier: Apache-2.0
// Any bytes as lines to the outputs of a layout: pulses that can be, or nothing.
#include "sim/instruments/actuator_outputs.h"

#include <cstdint>
#include <cstdlib>

#include "tests/fuzz/target.h"

namespace navcal::fuzz::actuator_outputs_target {

class AtRest final : public navcal::sim::Motion {
 public:
  [[nodiscard]] navcal::sim::State at(std::int64_t) const override { return {}; }
};

NAVCAL_FUZZ(actuator_outputs) {
  using namespace navcal::sim;
  const AtRest motion;
  ActuatorOutputs device(motion, [](std::int64_t, const auto& pulses_us) {
    if (pulses_us.size() != kMostOutputs) std::abort();
    for (const auto& pulse_us : pulses_us) {
      if (pulse_us && !(*pulse_us >= 500 && *pulse_us <= 2500)) std::abort();
    }
  });
  device.power_on(0);
  device.on_bytes(0, {data, size});
  return 0;
}

}  // namespace navcal::fuzz::actuator_outputs_target

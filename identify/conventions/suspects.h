// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/layout.h"
#include "identify/conventions/agreement.h"
#include "identify/data/recorded_motion.h"

namespace navcal::identify {

/// An error of conventions, and what undoes it.
struct Suspect {
  using MotionChange = std::function<void(RecordedMotion&)>;
  static constexpr auto kNothing = [](sim::ActuatorValues&) {};

  std::string name;   ///< empty: a fault that is no convention, and must not pass for one
  std::string what;   ///< channel or part
  std::string words;  ///< "with ..., they agree"
  MotionChange motion = [](RecordedMotion&) {};
  ActuatorChange actuators = kNothing;
  double log_prior = 0;  ///< beside the others
};

/// Errors of the instruments that the recording has.
[[nodiscard]] std::vector<Suspect> suspects_of_instruments(const RecordedMotion& motion);
/// Errors of the commands. Parts are numbered from 1, as in the layout.
[[nodiscard]] std::vector<Suspect> suspects_of_actuators(const config::Layout& layout);

}  // namespace navcal::identify

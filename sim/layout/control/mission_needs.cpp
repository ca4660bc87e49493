// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/control/mission_needs.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string_view>

namespace navcal::sim {
namespace {

using config::MissionStep;
using config::StepKind;

std::string_view word_for(StepKind kind) {
  constexpr std::array<std::string_view, 12> kWords{"leg",  "turn",    "circle", "spiral", "zigzag",  "pirouette",
                                                    "dive", "surface", "speed",  "swing",  "doublet", "direct"};
  return kWords[static_cast<std::size_t>(kind)];
}

bool needs_surge(const MissionStep& step) {
  return step.speed_m_s || step.metres || (step.shaft_rps && *step.shaft_rps > 0);
}

bool turns(const MissionStep& step, double start_heading_rad) {
  switch (step.kind) {
    case StepKind::turn:
    case StepKind::circle:
    case StepKind::spiral:
    case StepKind::zigzag:
    case StepKind::pirouette:
    case StepKind::swing: return true;
    case StepKind::doublet: return step.on == config::Surface::rudder;
    default: break;
  }
  if (step.by_rad && *step.by_rad != 0) return true;
  if (step.rudder_rad && *step.rudder_rad != 0) return true;
  return step.heading_rad &&
         std::abs(std::remainder(*step.heading_rad - start_heading_rad, 2 * std::numbers::pi)) > 1e-9;
}

}  // namespace

std::string step_words(const config::Mission& mission, std::size_t step) {
  return fmt::format("step[{}] ({})", step + 1, word_for(mission.steps[step].kind));
}

MissionNeeds needs_of(const config::Mission& mission) {
  MissionNeeds needs;
  for (std::size_t i = 0; i < mission.steps.size(); ++i) {
    const MissionStep& step = mission.steps[i];
    const auto note = [&](std::optional<std::string>& need, bool is_needed) {
      if (is_needed && !need) need = step_words(mission, i);
    };
    note(needs.surge, needs_surge(step));
    note(needs.yaw, turns(step, mission.start.heading_rad));
    const bool is_doublet = step.kind == StepKind::doublet;
    note(needs.pitch,
         (is_doublet && step.on == config::Surface::elevator) || (step.elevator_rad && *step.elevator_rad != 0));
    const std::array fins{step.fin1_rad, step.fin2_rad, step.fin3_rad};
    for (std::size_t fin = 0; fin < 3; ++fin) {
      const auto on = static_cast<config::Surface>(static_cast<std::size_t>(config::Surface::fin1) + fin);
      note(needs.fins[fin], fins[fin].has_value() || (is_doublet && step.on == on));
    }
  }
  return needs;
}

}  // namespace navcal::sim

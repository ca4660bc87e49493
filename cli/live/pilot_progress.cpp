// SPDX-License-Identifier: Apache-2.0
#include "cli/live/pilot_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/angles.h"
#include "config/mission_options.h"

namespace navcal::cli {
namespace {

std::string phase_of(const autopilot::Pilot& pilot) {
  if (pilot.stopping()) return pilot.reason() ? "stop: " + *pilot.reason() : "done";
  const config::Mission& mission = pilot.mission().mission();
  const auto& kinds = config::step_options().front().choices;
  const std::size_t step = std::min(pilot.mission().step(), mission.steps.size() - 1);
  return fmt::format("{}/{} {}", step + 1, mission.steps.size(),
                     kinds.at(static_cast<std::size_t>(mission.steps[step].kind)));
}

std::string known(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "?";
}

}  // namespace

std::string progress_text(const autopilot::Pilot& pilot, const autopilot::Reading& reading, double left_s) {
  std::string heading = "?";
  if (reading.heading_rad) {
    const double degrees = std::fmod(*reading.heading_rad * base::kDegreesPerRadian + 360, 360);
    heading = fmt::format("{:03}", std::lround(degrees) % 360);
  }
  const long left = std::lround(std::max(0.0, left_s));
  return fmt::format("{}, heading {}, depth {} m, speed {} m/s, {}:{:02} left", phase_of(pilot), heading,
                     known(reading.depth_m, 2), known(reading.speed_m_s, 2), left / 60, left % 60);
}

PilotProgress::PilotProgress() : on_terminal_(::isatty(STDERR_FILENO) != 0) {}

PilotProgress::~PilotProgress() {
  if (drawn_) std::fputs("\n", stderr);
}

void PilotProgress::show(const autopilot::Pilot& pilot, const autopilot::Reading& reading, double left_s) {
  if (on_terminal_) {
    // Not fmt::print: it throws when the terminal is gone, and the vehicle still has to be stopped.
    std::fputs(fmt::format("\r{}\x1b[K", progress_text(pilot, reading, left_s)).c_str(), stderr);
    drawn_ = true;
    return;
  }
  const std::string phase = phase_of(pilot);
  if (phase == phase_) return;
  phase_ = phase;
  std::fputs((progress_text(pilot, reading, left_s) + "\n").c_str(), stderr);
}

}  // namespace navcal::cli

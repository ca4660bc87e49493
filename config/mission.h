// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace navcal::config {

enum class StepKind : std::uint8_t {
  leg,        ///< heading and depth are held
  turn,       ///< the heading wanted moves to another
  circle,     ///< the same, by whole or broken turns
  spiral,     ///< a circle whose depth changes evenly
  zigzag,     ///< rudder over each time the heading has gone far enough the other way
  pirouette,  ///< one rudder until so many turns are done
  dive,       ///< until a depth is reached
  surface,    ///< up, and some time there
  speed,      ///< a step of the speed on a straight leg
  swing,      ///< stations all round, each held for a time
  doublet,    ///< one surface out, over, and back
  direct      ///< fins and shaft as stated, no autopilot
};

enum class Surface : std::uint8_t { rudder, elevator, fin1, fin2, fin3 };

/// One step of a mission, SI and radians; what a kind of step needs is there when a mission was read.
struct MissionStep {
  StepKind kind = StepKind::leg;
  unsigned line = 0;  ///< of the file
  std::optional<double> heading_rad{};
  std::optional<double> by_rad{};
  std::optional<double> turns{};  ///< positive to starboard
  std::optional<double> rate_rad_s{};
  std::optional<double> depth_m{};
  std::optional<double> shaft_rps{};
  std::optional<double> speed_m_s{};
  std::optional<double> seconds{};
  std::optional<double> metres{};
  std::optional<double> rudder_rad{};
  std::optional<double> elevator_rad{};
  std::optional<double> fin1_rad{};
  std::optional<double> fin2_rad{};
  std::optional<double> fin3_rad{};
  std::optional<double> reach_rad{};
  std::optional<double> amplitude_rad{};
  std::optional<int> times{};
  std::optional<int> stations{};
  Surface on = Surface::rudder;
};

struct MissionStart {
  double heading_rad = 0;
  double depth_m = 0.15;
  double speed_m_s = 0.05;
  double shaft_rps = 13;
};

enum class MissionEnd : std::uint8_t { repeat, hold };

/// Mission of an autopiloted vehicle (docs/simulator.md).
struct Mission {
  std::string description;
  MissionEnd at_end = MissionEnd::repeat;
  MissionStart start;
  std::vector<MissionStep> steps;
};

}  // namespace navcal::config

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/diagnose.h>
#include <navcal/export.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace navcal::api {

/// Options of a plan. The members have the names of the options of `navcal gap next`.
struct NextMissionOptions {
  DiagnoseOptions diagnosis;              ///< of the recordings so far; its progress is that of the plan as well
  std::optional<double> minutes;          ///< longest duration, 1 to 120; nullopt: that of the limits
  std::filesystem::path limits;           ///< file of depth, range, speed, turn rate, energy; empty: the defaults
  std::string mission_out = "next.toml";  ///< name of the mission's file in `json` and `page`; nothing is written
};

/// The mission that tells best what a diagnosis leaves open.
struct NextMission {
  bool decides = false;                 ///< whether an exact answer is probable afterwards
  double probability_now = 0;           ///< of the leading set of effects
  double probability_exact = 0;         ///< that the answer afterwards is the true set
  double duration_s = 0;                ///< of the mission
  std::vector<std::string> manoeuvres;  ///< in order, for people
  std::string sentence;                 ///< for people
  std::vector<std::string> remarks;     ///< for people
  std::string mission_toml;             ///< the mission: for SimulateOptions::mission, once it is in a file
  std::string json;                     ///< the answer of `navcal gap next --json -`, without its newline
  std::string page;                     ///< the answer of `navcal gap next --report`, HTML
};

/// Plans the mission within the limits that separates best what a diagnosis of these recordings leaves open, as
/// `navcal gap next` does. Takes as long as the diagnosis and some seconds more. Throws as diagnose_together()
/// does, and Error of the kind bad_argument where a recording cannot be diagnosed, or no mission fits the limits.
/// Source: docs/gap.md.
[[nodiscard]] NAVCAL_API NextMission plan_next_mission(const std::vector<std::filesystem::path>& missions,
                                                       const NextMissionOptions& options = {});

}  // namespace navcal::api

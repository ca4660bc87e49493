// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "validation/layout_cases.h"

namespace navcal::validation {

/// Of a case: to be diagnosed, and two held out.
inline constexpr int kRecordingsPerCase = 3;

struct LayoutRecordingsOptions {
  std::vector<NamedLayout> layouts;
  std::uint64_t seed = 1;
  int vehicles = 3, nominal = 3, cases = 16;
  double minutes = 3;
  LayoutErrors errors;
  std::filesystem::path folder;  ///< of the recordings; a new one, or one that is empty
  std::filesystem::path truth;   ///< file for the truth, outside the folder
};

/// Writes into the folder, for each vehicle, its layout as vehicle-N.toml and nominal recordings
/// vehicle-N-nominal-K.cap; for each case the recordings NNNN-a.cap (to be diagnosed), NNNN-b.cap and NNNN-c.cap;
/// navcald.toml and actuator-outputs.toml, by which they are read; and cases.jsonl with what may be known:
///     {"case":"0001","vehicle":1,"exclude":""}
/// Truth goes to a file of its own, a line of JSON for each vehicle and each case. An effect with which the
/// vehicle cannot swim is drawn anew. `progress`: of the share that is done. Throws std::invalid_argument
/// (layouts, folders), base::Failure (interrupted; no vehicle swims), std::system_error.
void write_layout_recordings(const LayoutRecordingsOptions& options, const std::function<void(double)>& progress);

/// The capture of one mission; empty when the vehicle was lost.
[[nodiscard]] std::string capture_of(const reference::thrusters::Swim& swim,
                                     const reference::thrusters::CraftUnderTest& craft, std::uint64_t seed);

/// Description of the line of outputs, as share/devices/actuator-outputs.toml has it, and a configuration with the
/// ports of the recordings that names it.
[[nodiscard]] std::string output_description();
[[nodiscard]] std::string recording_configuration();

}  // namespace navcal::validation
